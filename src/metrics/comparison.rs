//! All there is to say about how two images differ.

use serde::{Deserialize, Serialize};

use super::{Flip, Metrics, flip};
use crate::image::Image;

/// How an image differs from a reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// The errors in linear light, over the pixels kept.
    #[serde(flatten)]
    pub metrics: Metrics,
    /// The mean FLIP over all pixels, where those not kept are black in both images.
    pub flip: f64,
    /// Pixels with an infinity or a NaN in either image, kept or not. To all other figures
    /// such a value is 0.
    pub nonfinite: usize,
    /// FLIP at each pixel, row by row.
    #[serde(skip)]
    pub flip_map: Vec<f32>,
}

impl Comparison {
    /// Compares the pixels to keep, a flag for each, row by row; the exposure, in stops, is that
    /// at which FLIP looks. None if sizes differ or there is no pixel to compare.
    pub fn of(reference: &Image, image: &Image, keep: &[bool], exposure: f32) -> Option<Self> {
        let clean = [reference, image].map(|image| cleaned(image, keep));
        let metrics = Metrics::masked(&clean[1], &clean[0], keep)?;
        let Flip { map, mean } = flip(&clean[0], &clean[1], exposure)?;
        let pairs = reference.pixels.iter().zip(&image.pixels);
        let nonfinite = pairs.filter(|(r, x)| !is_finite(r) || !is_finite(x)).count();
        Some(Self { metrics, flip: mean, nonfinite, flip_map: map })
    }
}

fn is_finite(pixel: &[f32; 3]) -> bool {
    pixel.iter().all(|channel| channel.is_finite())
}

/// The image with 0 for what is not finite, and for pixels not to keep.
fn cleaned(image: &Image, keep: &[bool]) -> Image {
    let clean = |(pixel, keep): (&[f32; 3], &bool)| {
        pixel.map(|value| if *keep && value.is_finite() { value } else { 0.0 })
    };
    let pixels = image.pixels.iter().zip(keep).map(clean).collect();
    Image { width: image.width, height: image.height, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_counted_and_read_as_zero() {
        let reference = Image { width: 2, height: 2, pixels: vec![[1.0; 3]; 4] };
        let (mut broken, mut black) = (reference.clone(), reference.clone());
        broken.pixels[2] = [f32::NAN, 1.0, f32::INFINITY];
        black.pixels[2] = [0.0, 1.0, 0.0];
        let [broken, black] = [broken, black]
            .map(|image| Comparison::of(&reference, &image, &[true; 4], 0.0).unwrap());
        assert_eq!((broken.nonfinite, black.nonfinite), (1, 0));
        assert_eq!((broken.metrics, broken.flip), (black.metrics, black.flip));
        assert!((broken.metrics.mae - 2.0 / 12.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_masked_is_compared_by_no_metric() {
        let reference = Image { width: 2, height: 1, pixels: vec![[1.0; 3], [0.25; 3]] };
        let mut other = reference.clone();
        other.pixels[0] = [f32::INFINITY; 3];
        let masked = Comparison::of(&reference, &other, &[false, true], 0.0).unwrap();
        assert_eq!((masked.metrics.rmse, masked.flip, masked.nonfinite), (0.0, 0.0, 1));
        assert!(Comparison::of(&reference, &other, &[false; 2], 0.0).is_none());
    }
}
