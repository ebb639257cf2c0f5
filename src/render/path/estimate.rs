//! Mean and standard error of the pixels, from sums over some samples at a time.

use std::ops::Range;

use crate::gpu::PathSum;
use crate::image::Image;
use crate::render::camera::pixel_of;

/// Running mean and spread of the pixels of a tile, in f64: thousands of samples lose nothing.
#[derive(Debug, Clone)]
pub struct Estimates {
    samples: f64,
    pixels: Vec<Estimate>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Estimate {
    mean: [f64; 3],
    /// Sum of the squared deviations from the mean.
    squares: [f64; 3],
}

impl Estimates {
    /// Of so many pixels, without a sample.
    pub fn new(pixels: usize) -> Self {
        Self { samples: 0.0, pixels: vec![Estimate::default(); pixels] }
    }

    /// Adds `samples` samples of every pixel. Returns how many shadow rays they took.
    ///
    /// Chan, Golub and LeVeque, "Updating Formulae and a Pairwise Algorithm for Computing Sample
    /// Variances", 1979.
    pub fn add(&mut self, sums: &[PathSum], samples: u32) -> u64 {
        let samples = f64::from(samples);
        let all = self.samples + samples;
        let mut shadow_rays = 0;
        for (pixel, sum) in self.pixels.iter_mut().zip(sums) {
            for channel in 0..3 {
                let step = f64::from(sum.mean[channel]) - pixel.mean[channel];
                pixel.mean[channel] += step * samples / all;
                pixel.squares[channel] +=
                    f64::from(sum.squares[channel]) + step * step * self.samples * samples / all;
            }
            shadow_rays += sum.shadow_rays as u64;
        }
        self.samples = all;
        shadow_rays
    }

    /// Puts the means into the image, and the standard errors of the means, which take two
    /// samples. `blocks` are the 8 × 8 blocks of the pixels.
    pub fn develop(&self, blocks: &Range<u32>, image: &mut Image, error: Option<&mut Image>) {
        let place = |point: usize| {
            let [x, y] = pixel_of(point as u32, blocks.start, image.width);
            let inside = x < image.width && y < image.height;
            inside.then(|| y as usize * image.width as usize + x as usize)
        };
        let places: Vec<_> = (0..self.pixels.len()).map(place).collect();
        let each = || places.iter().zip(&self.pixels).filter_map(|(at, of)| Some(((*at)?, of)));
        for (at, pixel) in each() {
            image.pixels[at] = pixel.mean.map(|mean| mean as f32);
        }
        if let Some(error) = error {
            let scale = self.samples * (self.samples - 1.0);
            for (at, pixel) in each() {
                error.pixels[at] = pixel.squares.map(|squares| (squares / scale).sqrt() as f32);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum_of(samples: &[f64]) -> PathSum {
        let mean = samples.iter().sum::<f64>() / samples.len() as f64;
        let squares = samples.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
        let [mean, squares] = [mean, squares].map(|x| [x as f32; 3]);
        PathSum { mean, shadow_rays: samples.len() as f32, squares, pad: 0.0 }
    }

    #[test]
    fn samples_in_parts_give_mean_and_error_of_all() {
        let samples = [1.0, 2.0, 4.0, 8.0, 16.0, 1000.0];
        let mean = samples.iter().sum::<f64>() / 6.0;
        let variance = samples.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 5.0;
        for parts in [vec![6], vec![1, 5], vec![2, 2, 2], vec![1; 6]] {
            let mut estimates = Estimates::new(64);
            let mut rest = &samples[..];
            let mut rays = 0;
            for part in parts {
                let (these, others) = rest.split_at(part);
                rays += estimates.add(&[sum_of(these); 64], part as u32);
                rest = others;
            }
            assert_eq!(rays, 6 * 64);
            let black = Image { width: 8, height: 8, pixels: vec![[0.0; 3]; 64] };
            let (mut image, mut error) = (black.clone(), black);
            estimates.develop(&(0..1), &mut image, Some(&mut error));
            for (got, expected) in [(&image, mean), (&error, (variance / 6.0).sqrt())] {
                let off = |got: f32| (f64::from(got) / expected - 1.0).abs();
                assert!(got.pixels.iter().flatten().all(|&got| off(got) < 1e-6));
            }
        }
    }
}
