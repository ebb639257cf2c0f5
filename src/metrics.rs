//! How far an image is from a reference: over all channels of all pixels, linear and not
//! weighted, summed in f64. Below, x is a value of the image, r the reference's, and mean()
//! goes over all pixels and channels.

use serde::Serialize;

use crate::image::Image;

/// The distance of an image from a reference.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Metrics {
    /// √mean((x − r)²).
    pub rmse: f64,
    /// RMSE / mean(r); infinite where a black reference is missed.
    pub nrmse: f64,
    /// (mean(x) − mean(r)) / mean(r): above 0 the image is too bright.
    pub bias: f64,
    /// mean((x − r)² / (r² + 0.01 · mean(r)²)).
    pub relmse: f64,
    /// max |x − r|.
    pub max_abs: f64,
}

impl Metrics {
    /// Compares an image with a reference; none if their sizes differ or they are empty.
    pub fn of(image: &Image, reference: &Image) -> Option<Self> {
        let same = [image.width, image.height] == [reference.width, reference.height]
            && image.pixels.len() == reference.pixels.len();
        if !same || reference.pixels.is_empty() {
            return None;
        }
        let count = 3.0 * reference.pixels.len() as f64;
        let values = |image: &'_ Image| {
            image.pixels.iter().flatten().map(|&value| f64::from(value)).collect::<Vec<_>>()
        };
        let (image, reference) = (values(image), values(reference));
        let mean = reference.iter().sum::<f64>() / count;
        let floor = 0.01 * mean * mean;

        let (mut squares, mut relative, mut signed, mut max_abs) = (0.0, 0.0, 0.0, 0.0_f64);
        for (x, r) in image.iter().zip(&reference) {
            let difference = x - r;
            let square = difference * difference;
            squares += square;
            signed += difference;
            relative += ratio(square, r * r + floor);
            // Not f64::max, which would pass over a NaN.
            if difference.abs() > max_abs || difference.is_nan() {
                max_abs = difference.abs();
            }
        }
        let rmse = (squares / count).sqrt();
        Some(Self {
            rmse,
            nrmse: ratio(rmse, mean),
            bias: ratio(signed / count, mean),
            relmse: relative / count,
            max_abs,
        })
    }
}

/// A quotient in which nothing is no part of anything, not even of nothing.
fn ratio(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(pixels: &[[f32; 3]]) -> Image {
        Image { width: pixels.len() as u32, height: 1, pixels: pixels.to_vec() }
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-12 * b.abs().max(1.0)
    }

    #[test]
    fn an_image_equals_itself() {
        let one = image(&[[0.25, 0.5, 4.0], [0.0, 1.0, 2.0]]);
        assert_eq!(Metrics::of(&one, &one), Some(Metrics::default()));
        let black = image(&[[0.0; 3]]);
        assert_eq!(Metrics::of(&black, &black), Some(Metrics::default()));
    }

    #[test]
    fn each_metric_follows_its_formula() {
        let reference = image(&[[1.0, 1.0, 1.0], [3.0, 3.0, 3.0]]);
        let other = image(&[[2.0, 1.0, 1.0], [3.0, 3.0, 1.0]]);
        let metrics = Metrics::of(&other, &reference).unwrap();
        assert!(close(metrics.rmse, (5.0_f64 / 6.0).sqrt()));
        assert!(close(metrics.nrmse, (5.0_f64 / 6.0).sqrt() / 2.0));
        assert!(close(metrics.bias, -1.0 / 6.0 / 2.0));
        assert!(close(metrics.relmse, (1.0 / 1.04 + 4.0 / 9.04) / 6.0));
        assert!(close(metrics.max_abs, 2.0));
    }

    #[test]
    fn one_perturbed_value_is_seen() {
        let reference = image(&[[0.5; 3]; 100]);
        let mut other = reference.clone();
        other.pixels[57][1] += 1e-4;
        let metrics = Metrics::of(&other, &reference).unwrap();
        let Metrics { rmse, nrmse, bias, relmse, max_abs } = metrics;
        assert!([rmse, nrmse, bias, relmse, max_abs].iter().all(|&value| value > 0.0));
    }

    #[test]
    fn what_is_not_finite_is_not_overlooked() {
        let reference = image(&[[0.5; 3]; 3]);
        let broken = image(&[[0.5; 3], [0.5, f32::NAN, 0.5], [0.5; 3]]);
        let metrics = Metrics::of(&broken, &reference).unwrap();
        assert!(metrics.rmse.is_nan() && metrics.relmse.is_nan() && metrics.bias.is_nan());
        assert!(Metrics::of(&reference, &image(&[[0.0; 3]; 3])).unwrap().nrmse.is_infinite());
    }

    #[test]
    fn images_of_different_sizes_are_not_compared() {
        assert_eq!(Metrics::of(&image(&[[0.0; 3]; 2]), &image(&[[0.0; 3]; 3])), None);
        assert_eq!(Metrics::of(&image(&[]), &image(&[])), None);
    }
}
