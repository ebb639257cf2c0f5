//! FLIP's filters: sums of Gaussians and derivatives of one, all separable. Beyond its border
//! an image repeats what is at the border.

use std::f32::consts::PI;

use rayon::prelude::*;

/// Pixels in a degree of the visual field: 3840 on 0.7 m, seen from 0.7 m.
const PIXELS_PER_DEGREE: f32 = 67.020_64;

/// One channel of an image.
pub struct Plane {
    width: usize,
    /// Row by row.
    pub values: Vec<f32>,
}

impl Plane {
    /// A plane of this width and height, neither of them 0, row by row.
    pub fn new([width, height]: [usize; 2], values: impl Iterator<Item = f32>) -> Self {
        let values: Vec<f32> = values.collect();
        debug_assert_eq!(values.len(), width * height);
        Self { width, values }
    }
}

/// A Gaussian of unit sum, and its weight in a sum of them.
pub struct Weighted {
    weight: f32,
    kernel: Vec<f32>,
}

/// The eye's contrast sensitivity in Y, Cx, Cz as sums of a √(π/b) exp(−π²x²/b), x in degrees
/// (section 5.1, table 1). The weights of a channel sum to 1.
pub fn contrast_sensitivity() -> [Vec<Weighted>; 3] {
    const Y: [[f32; 2]; 1] = [[1.0, 0.0047]];
    const CX: [[f32; 2]; 1] = [[1.0, 0.0053]];
    const CZ: [[f32; 2]; 2] = [[34.1, 0.04], [13.5, 0.025]];
    // Three standard deviations of the widest.
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil();
    [&Y[..], &CX, &CZ].map(|terms| {
        let gaussian = |&[a, b]: &[f32; 2]| {
            let at = |x: f32| libm::expf(-(PI * x / PIXELS_PER_DEGREE).powi(2) / b);
            let kernel = sampled(radius, at);
            let sum: f32 = kernel.iter().sum();
            // The filter is two-dimensional: its sum is the square of a row's.
            Weighted { weight: a * (PI / b).sqrt() * sum * sum, kernel: scaled(kernel, 1.0 / sum) }
        };
        let mut gaussians: Vec<Weighted> = terms.iter().map(gaussian).collect();
        let sum: f32 = gaussians.iter().map(|gaussian| gaussian.weight).sum();
        gaussians.iter_mut().for_each(|gaussian| gaussian.weight /= sum);
        gaussians
    })
}

/// A Gaussian and its derivatives (section 5.2).
pub struct Detectors {
    /// Of unit sum.
    pub gaussian: Vec<f32>,
    /// The first derivative: finds edges. Its positive weights sum to 1, the negative to −1.
    pub edge: Vec<f32>,
    /// The second derivative: finds points and lines, and is scaled likewise.
    pub point: Vec<f32>,
}

/// Detectors as wide as the eye's own: 0.082 degrees.
pub fn feature_detectors() -> Detectors {
    let deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * deviation).ceil();
    let gaussian = |x: f32| libm::expf(-0.5 * (x / deviation).powi(2));
    let plain = sampled(radius, gaussian);
    let sum: f32 = plain.iter().sum();
    let edge = sampled(radius, |x| -x * gaussian(x));
    let point = sampled(radius, |x| ((x / deviation).powi(2) - 1.0) * gaussian(x));
    Detectors { gaussian: scaled(plain, 1.0 / sum), edge: balanced(edge), point: balanced(point) }
}

fn sampled(radius: f32, value: impl Fn(f32) -> f32) -> Vec<f32> {
    let radius = radius as i32;
    (-radius..=radius).map(|x| value(x as f32)).collect()
}

fn scaled(kernel: Vec<f32>, factor: f32) -> Vec<f32> {
    kernel.into_iter().map(|weight| weight * factor).collect()
}

/// Scales positive weights to a sum of 1 and negative ones to −1.
fn balanced(kernel: Vec<f32>) -> Vec<f32> {
    let positive: f32 = kernel.iter().filter(|&&weight| weight > 0.0).sum();
    let negative: f32 = -kernel.iter().filter(|&&weight| weight < 0.0).sum::<f32>();
    let scale = |weight: f32| weight / if weight > 0.0 { positive } else { negative };
    kernel.into_iter().map(scale).collect()
}

/// Filters with a weighted sum of round Gaussians.
pub fn sum_of_gaussians(plane: &Plane, gaussians: &[Weighted]) -> Plane {
    let mut sum = Plane { width: plane.width, values: vec![0.0; plane.values.len()] };
    for Weighted { weight, kernel } in gaussians {
        let blurred = separable(plane, kernel, kernel);
        add(&mut sum.values, *weight, &blurred.values);
    }
    sum
}

/// Filters rows with one kernel and columns with another, both of odd length and centred.
pub fn separable(plane: &Plane, along_x: &[f32], along_y: &[f32]) -> Plane {
    columns(&rows(plane, along_x), along_y)
}

fn rows(plane: &Plane, kernel: &[f32]) -> Plane {
    let width = plane.width;
    let radius = kernel.len() / 2;
    let mut values = vec![0.0; plane.values.len()];
    let rows = values.par_chunks_mut(width).zip(plane.values.par_chunks(width));
    rows.for_each(|(out, row)| {
        let repeated = |value: f32| std::iter::repeat_n(value, radius);
        let padded: Vec<f32> =
            repeated(row[0]).chain(row.iter().copied()).chain(repeated(row[width - 1])).collect();
        for (offset, &weight) in kernel.iter().enumerate() {
            add(out, weight, &padded[offset..offset + width]);
        }
    });
    Plane { width, values }
}

fn columns(plane: &Plane, kernel: &[f32]) -> Plane {
    let width = plane.width;
    let last = plane.values.len() / width - 1;
    let radius = kernel.len() / 2;
    let mut values = vec![0.0; plane.values.len()];
    values.par_chunks_mut(width).enumerate().for_each(|(y, out)| {
        for (offset, &weight) in kernel.iter().enumerate() {
            let row = (y + offset).saturating_sub(radius).min(last);
            add(out, weight, &plane.values[row * width..][..width]);
        }
    });
    Plane { width, values }
}

fn add(sum: &mut [f32], weight: f32, values: &[f32]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += weight * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_passes_blurs_and_stops_detectors() {
        let plane = Plane::new([5, 3], std::iter::repeat_n(0.5, 15));
        for gaussians in contrast_sensitivity() {
            let blurred = sum_of_gaussians(&plane, &gaussians);
            assert!(blurred.values.iter().all(|value| (value - 0.5).abs() < 1e-6));
        }
        let Detectors { gaussian, edge, point } = feature_detectors();
        for kernel in [edge, point] {
            for [along_x, along_y] in [[&kernel, &gaussian], [&gaussian, &kernel]] {
                let found = separable(&plane, along_x, along_y);
                assert!(found.values.iter().all(|value| value.abs() < 1e-6));
            }
        }
    }

    #[test]
    fn the_border_is_repeated() {
        let plane = Plane::new([2, 2], [1.0, 2.0, 3.0, 4.0].into_iter());
        let shifted = separable(&plane, &[0.0, 0.0, 0.0, 0.0, 1.0], &[1.0, 0.0, 0.0]);
        assert_eq!(shifted.values, [2.0, 2.0, 2.0, 2.0]);
    }
}
