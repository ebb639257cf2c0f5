//! Errors in linear light: over all channels of all pixels, not weighted, summed in f64. Below,
//! x is a value of the image, r the reference's, and mean() goes over the pixels compared and
//! their channels.

use serde::{Deserialize, Serialize};

use crate::image::Image;

/// The side of a tile in pixels.
const TILE: usize = 16;

/// The distance of an image from a reference.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Metrics {
    /// √mean((x − r)²).
    pub rmse: f64,
    /// mean(|x − r|).
    pub mae: f64,
    /// (mean(x) − mean(r)) / mean(r): above 0 the image is too bright.
    pub bias: f64,
    /// RMSE / mean(r); infinite where a black reference is missed.
    pub nrmse: f64,
    /// mean((x − r)² / (r² + 0.01 · mean(r)²)).
    pub relmse: f64,
    /// The RMSE of the means of 16 × 16 tiles over mean(r), blind to noise and antialiasing.
    /// Tiles that the right or lower edge cuts are left out; none where no tile is whole.
    pub tile_nrmse: Option<f64>,
    /// max |x − r|.
    pub max_abs: f64,
}

impl Metrics {
    /// Compares an image with a reference; none if their sizes differ or they are empty.
    pub fn of(image: &Image, reference: &Image) -> Option<Self> {
        Self::masked(image, reference, &vec![true; reference.pixels.len()])
    }

    /// Compares the pixels to keep, a flag for each, row by row; none if sizes differ or there
    /// is no pixel to compare.
    pub fn masked(image: &Image, reference: &Image, keep: &[bool]) -> Option<Self> {
        let same = [image.width, image.height] == [reference.width, reference.height]
            && image.pixels.len() == reference.pixels.len()
            && keep.len() == reference.pixels.len();
        if !same || !keep.contains(&true) {
            return None;
        }
        let (values, expected) = (kept(image, keep), kept(reference, keep));
        let count = expected.len() as f64;
        let mean = expected.iter().sum::<f64>() / count;
        let floor = 0.01 * mean * mean;

        let (mut squares, mut relative, mut signed) = (0.0, 0.0, 0.0);
        let (mut absolute, mut max_abs) = (0.0, 0.0_f64);
        for (x, r) in values.iter().zip(&expected) {
            let difference = x - r;
            let square = difference * difference;
            squares += square;
            signed += difference;
            absolute += difference.abs();
            relative += ratio(square, r * r + floor);
            // Not f64::max, which would pass over a NaN.
            if difference.abs() > max_abs || difference.is_nan() {
                max_abs = difference.abs();
            }
        }
        let rmse = (squares / count).sqrt();
        Some(Self {
            rmse,
            mae: absolute / count,
            bias: ratio(signed / count, mean),
            nrmse: ratio(rmse, mean),
            relmse: relative / count,
            tile_nrmse: tile_rmse(image, reference, keep).map(|rmse| ratio(rmse, mean)),
            max_abs,
        })
    }
}

/// The channels of the pixels to keep.
fn kept(image: &Image, keep: &[bool]) -> Vec<f64> {
    let pixels = image.pixels.iter().zip(keep).filter(|(_, keep)| **keep);
    pixels.flat_map(|(pixel, _)| pixel.map(f64::from)).collect()
}

fn tile_rmse(image: &Image, reference: &Image, keep: &[bool]) -> Option<f64> {
    let (means, expected) = (tile_means(image, keep), tile_means(reference, keep));
    let differences = means.as_flattened().iter().zip(expected.as_flattened()).map(|(x, r)| x - r);
    let squares: f64 = differences.map(|difference| difference * difference).sum();
    (!means.is_empty()).then(|| (squares / (3 * means.len()) as f64).sqrt())
}

/// The mean of the pixels to keep in each whole tile that has any.
fn tile_means(image: &Image, keep: &[bool]) -> Vec<[f64; 3]> {
    let width = image.width as usize;
    let (columns, rows) = (width / TILE, image.height as usize / TILE);
    let mean = |tile: usize| {
        let corner = tile / columns * TILE * width + tile % columns * TILE;
        let pixels = (0..TILE).flat_map(|row| (0..TILE).map(move |x| corner + row * width + x));
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for index in pixels.filter(|&index| keep[index]) {
            count += 1.0;
            for (sum, &value) in sum.iter_mut().zip(&image.pixels[index]) {
                *sum += f64::from(value);
            }
        }
        (count > 0.0).then(|| sum.map(|sum| sum / count))
    };
    (0..columns * rows).filter_map(mean).collect()
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
        assert!(close(metrics.mae, 0.5));
        assert!(close(metrics.nrmse, (5.0_f64 / 6.0).sqrt() / 2.0));
        assert!(close(metrics.bias, -1.0 / 6.0 / 2.0));
        assert!(close(metrics.relmse, (1.0 / 1.04 + 4.0 / 9.04) / 6.0));
        assert!(close(metrics.max_abs, 2.0));
    }

    #[test]
    fn tiles_see_means_alone() {
        // Two whole tiles and a remainder to the right and below.
        let reference = Image { width: 37, height: 18, pixels: vec![[1.0; 3]; 37 * 18] };
        let mut other = reference.clone();
        (other.pixels[0], other.pixels[38]) = ([0.0; 3], [2.0; 3]);
        other.pixels[36] = [9.0; 3];
        assert_eq!(Metrics::of(&other, &reference).unwrap().tile_nrmse, Some(0.0));
        other.pixels[20] = [257.0; 3];
        let metrics = Metrics::of(&other, &reference).unwrap();
        assert!(close(metrics.tile_nrmse.unwrap(), 0.5_f64.sqrt()));
        let small = image(&[[1.0; 3]; 100]);
        assert_eq!(Metrics::of(&small, &small).unwrap().tile_nrmse, None);
    }

    #[test]
    fn a_mask_leaves_pixels_out() {
        let reference = image(&[[1.0; 3], [3.0; 3], [100.0; 3]]);
        let other = image(&[[2.0; 3], [3.0; 3], [f32::NAN; 3]]);
        let metrics = Metrics::masked(&other, &reference, &[true, true, false]).unwrap();
        let pair = |source: &Image| image(&source.pixels[..2]);
        assert_eq!(Some(metrics), Metrics::of(&pair(&other), &pair(&reference)));
        assert_eq!(Metrics::masked(&other, &reference, &[false; 3]), None);
        assert_eq!(Metrics::masked(&other, &reference, &[true; 2]), None);
    }

    #[test]
    fn one_perturbed_value_is_seen() {
        let reference = image(&[[0.5; 3]; 100]);
        let mut other = reference.clone();
        other.pixels[57][1] += 1e-4;
        let metrics = Metrics::of(&other, &reference).unwrap();
        let Metrics { rmse, mae, bias, nrmse, relmse, tile_nrmse: _, max_abs } = metrics;
        assert!([rmse, mae, bias, nrmse, relmse, max_abs].iter().all(|&value| value > 0.0));
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
