//! From linear data to the 8 bits a screen shows.

use rayon::prelude::*;

use super::Image;

/// How the data of an image becomes 8-bit values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tone {
    /// sRGB of clamp(2^exposure · L).
    Radiance {
        /// In stops (EV).
        exposure: f32,
    },
    /// Unit vectors as data, 0.5 n + 0.5, without a tone curve.
    Normal,
    /// A linear ramp of distance over the largest finite distance: near is dark, the farthest
    /// surface white; black where nothing is hit.
    Depth,
}

/// RGB bytes, row by row. A NaN becomes 0.
pub fn to_rgb8(image: &Image, tone: Tone) -> Vec<u8> {
    match tone {
        Tone::Radiance { exposure } => {
            let gain = libm::exp2(f64::from(exposure));
            map(image, |value| quantize(srgb(gain * value)))
        }
        Tone::Normal => map(image, |value| quantize(0.5 * value + 0.5)),
        Tone::Depth => {
            let farthest = farthest(image);
            map(image, |value| quantize(value / farthest))
        }
    }
}

/// The sRGB transfer function (IEC 61966-2-1) of a linear value clamped to [0, 1].
pub fn srgb(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    }
}

/// The inverse of [`srgb`], of a value in [0, 1].
pub fn linear(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
}

/// Rounds [0, 1] to a byte; what lies outside is clamped, NaN is 0 as casts have it.
fn quantize(value: f64) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}

fn map(image: &Image, byte: impl Fn(f64) -> u8 + Sync) -> Vec<u8> {
    let mut bytes = vec![0; image.pixels.len() * 3];
    let channels = image.pixels.as_flattened();
    bytes.par_iter_mut().zip(channels).with_min_len(4096).for_each(|(out, &value)| {
        *out = byte(f64::from(value));
    });
    bytes
}

/// The largest finite value, 1 where there is none above 0.
fn farthest(image: &Image) -> f64 {
    let channels = image.pixels.as_flattened();
    let largest = channels.iter().copied().filter(|v| v.is_finite()).fold(0.0, f32::max);
    if largest > 0.0 { f64::from(largest) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(pixel: [f32; 3], tone: Tone) -> Vec<u8> {
        to_rgb8(&Image { width: 1, height: 1, pixels: vec![pixel] }, tone)
    }

    #[test]
    fn srgb_has_its_known_values() {
        // 0.5 → 188, middle grey 0.18 → 118, 0.0031308 → 0.04045: the standard's own figures.
        let tone = Tone::Radiance { exposure: 0.0 };
        assert_eq!(bytes([0.0, 0.5, 1.0], tone), [0, 188, 255]);
        assert_eq!(bytes([0.18, 2.0, -1.0], tone), [118, 255, 0]);
        assert!((srgb(0.003_130_8) - 0.04045).abs() < 1e-5);
    }

    #[test]
    fn linear_undoes_srgb() {
        for step in 0..=1000 {
            let value = f64::from(step) / 1000.0;
            assert!((linear(srgb(value)) - value).abs() < 1e-6, "{value}");
        }
    }

    #[test]
    fn exposure_counts_in_stops() {
        let tone = Tone::Radiance { exposure: 1.0 };
        assert_eq!(bytes([0.25; 3], tone), [188; 3]);
        let tone = Tone::Radiance { exposure: -1.0 };
        assert_eq!(bytes([1.0; 3], tone), [188; 3]);
    }

    #[test]
    fn what_is_not_finite_is_shown_without_harm() {
        let pixel = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
        assert_eq!(bytes(pixel, Tone::Radiance { exposure: 0.0 }), [0, 255, 0]);
        let extreme = Tone::Radiance { exposure: 1e30 };
        assert_eq!(bytes([0.0, 1.0, -1.0], extreme), [0, 255, 0]);
        assert_eq!(bytes([f32::NAN; 3], Tone::Depth), [0; 3]);
    }

    #[test]
    fn data_has_no_tone_curve() {
        assert_eq!(bytes([-1.0, 0.0, 1.0], Tone::Normal), [0, 128, 255]);
        let pixels = vec![[0.0; 3], [10.0; 3], [20.0; 3]];
        let image = Image { width: 3, height: 1, pixels };
        assert_eq!(to_rgb8(&image, Tone::Depth), [0, 0, 0, 128, 128, 128, 255, 255, 255]);
    }
}
