//! Where an image is wrong: a map of errors, one a pixel.

use std::io;

use crate::image::exr::{Plane, Value};
use crate::image::heat::{self, Range};
use crate::image::output::Sink;
use crate::image::{Format, Image, exr, png};
use crate::metrics::Comparison;

/// What an error map shows of each pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MapKind {
    /// The root of the mean of the channels' squared errors, of which the image's RMSE is the
    /// root mean square.
    Magnitude,
    /// The mean of the channels' errors, of which the image's bias is the mean.
    Signed,
    /// FLIP.
    Flip,
}

impl MapKind {
    /// From its name.
    ///
    /// # Errors
    /// It is none.
    pub fn parse(text: &str) -> Result<Self, String> {
        match text {
            "magnitude" => Ok(Self::Magnitude),
            "signed" => Ok(Self::Signed),
            "flip" => Ok(Self::Flip),
            _ => Err("give magnitude, signed or flip".to_owned()),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Magnitude => "magnitude",
            Self::Signed => "signed",
            Self::Flip => "flip",
        }
    }

    fn of(self, reference: [f32; 3], image: [f32; 3], flip: f32) -> f32 {
        let errors = [0, 1, 2].map(|c| f64::from(image[c]) - f64::from(reference[c]));
        let error = match self {
            Self::Magnitude => (errors.iter().map(|e| e * e).sum::<f64>() / 3.0).sqrt(),
            Self::Signed => errors.iter().sum::<f64>() / 3.0,
            // Where a value is not finite, FLIP saw another.
            Self::Flip if errors.iter().all(|error| error.is_finite()) => f64::from(flip),
            Self::Flip => f64::NAN,
        };
        error as f32
    }
}

/// Errors and how they are shown.
#[derive(Debug)]
pub struct ErrorMap<'a> {
    kind: MapKind,
    size: [u32; 2],
    /// One a pixel, row by row; 0 where nothing is compared, and not finite where one of the
    /// images is not.
    values: Vec<f32>,
    keep: &'a [bool],
    /// The error at the end of the colours.
    pub scale: f64,
}

impl<'a> ErrorMap<'a> {
    /// The map of two images of one size.
    pub fn new(
        kind: MapKind,
        reference: &Image,
        image: &Image,
        keep: &'a [bool],
        comparison: &Comparison,
        scale: Option<f64>,
    ) -> Self {
        let pixels = reference.pixels.iter().zip(&image.pixels).zip(&comparison.flip_map);
        let value = |(((&reference, &image), &flip), &keep)| {
            if keep { kind.of(reference, image, flip) } else { 0.0 }
        };
        let values: Vec<f32> = pixels.zip(keep).map(value).collect();
        let scale = scale.unwrap_or_else(|| match kind {
            MapKind::Flip => 1.0,
            MapKind::Magnitude | MapKind::Signed => usual(&values, keep),
        });
        Self { kind, size: [image.width, image.height], values, keep, scale }
    }

    /// Writes it as a picture with its scale, or as an EXR file of the errors themselves, in R,
    /// G and B alike so that any reader finds them.
    ///
    /// # Errors
    /// The sink or the encoder refuses.
    pub fn write(&self, out: &mut dyn Sink, format: Format) -> io::Result<()> {
        match format {
            Format::Png => {
                let range = match self.kind {
                    MapKind::Signed => Range::Signed(self.scale),
                    MapKind::Magnitude | MapKind::Flip => Range::Positive(self.scale),
                };
                let canvas = heat::draw(self.size, &self.values, self.keep, range);
                png::write_rgb8(out, canvas.size, &canvas.bytes)
            }
            Format::Exr => {
                let pixels = self.values.iter().map(|&value| [value; 3]).collect();
                let [width, height] = self.size;
                let image = Image { width, height, pixels };
                let plane = Plane { layer: "", channels: "RGB", image: &image };
                let metadata = vec![("error", Value::Text(self.kind.name().to_owned()))];
                exr::write(out, &[plane], &metadata)
            }
        }
    }
}

/// What the magnitudes of 99 % of the finite values are within; the largest if that is 0, and 1
/// if that is 0 as well.
fn usual(values: &[f32], keep: &[bool]) -> f64 {
    let kept = values.iter().zip(keep).filter(|(value, keep)| **keep && value.is_finite());
    let mut magnitudes: Vec<f32> = kept.map(|(value, _)| value.abs()).collect();
    magnitudes.sort_unstable_by(f32::total_cmp);
    let percentile = magnitudes.len().saturating_mul(99).div_ceil(100).saturating_sub(1);
    let found = [magnitudes.get(percentile), magnitudes.last()];
    found.into_iter().flatten().copied().find(|&value| value > 0.0).map_or(1.0, f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_of_their_kind() {
        let (r, x) = ([1.0, 1.0, 1.0], [1.0, 3.0, 0.0]);
        assert!((MapKind::Magnitude.of(r, x, 0.5) - (5.0_f32 / 3.0).sqrt()).abs() < 1e-6);
        assert!((MapKind::Signed.of(r, x, 0.5) - 1.0 / 3.0).abs() < 1e-6);
        assert_eq!(MapKind::Flip.of(r, x, 0.5), 0.5);
        for kind in [MapKind::Magnitude, MapKind::Signed, MapKind::Flip] {
            assert!(!kind.of(r, [f32::NAN, 1.0, 1.0], 0.5).is_finite());
        }
    }

    #[test]
    fn the_scale_passes_over_outliers() {
        let mut values: Vec<f32> = (1..=200).map(|value| value as f32).collect();
        assert_eq!(usual(&values, &[true; 200]), 198.0);
        values[0] = f32::INFINITY;
        assert_eq!(usual(&values[..2], &[true, true]), 2.0);
        assert_eq!(usual(&values, &[false; 200]), 1.0);
        let mut one = [0.0; 1000];
        assert_eq!(usual(&one, &[true; 1000]), 1.0);
        one[7] = -5.0;
        assert_eq!(usual(&one, &[true; 1000]), 5.0);
    }
}
