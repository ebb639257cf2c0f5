//! The difference between two images as it is seen when they alternate: LDR-FLIP, Andersson et
//! al., "FLIP: A Difference Evaluator for Alternating Images", 2020. Section numbers below are
//! that paper's.

mod colour;
mod filter;

use glam::Vec3;
use rayon::prelude::*;

use crate::image::Image;
use filter::Plane;

/// The exponent of feature differences, q_f (section 5.2).
const FEATURE_EXPONENT: f32 = 0.5;

/// How different two images look.
#[derive(Debug, Clone, PartialEq)]
pub struct Flip {
    /// The difference at each pixel, row by row, from 0 (none) to 1.
    pub map: Vec<f32>,
    /// The mean over all pixels.
    pub mean: f64,
}

/// FLIP of two images shown as clamp(2^exposure · L) in sRGB, 67 pixels a degree; what is not
/// finite should be replaced before. None if their sizes differ or they are empty.
pub fn flip(reference: &Image, image: &Image, exposure: f32) -> Option<Flip> {
    let same = [image.width, image.height] == [reference.width, reference.height]
        && image.pixels.len() == reference.pixels.len();
    if !same || reference.pixels.is_empty() {
        return None;
    }
    let gain = libm::exp2(f64::from(exposure));
    let (reference, image) = (Seen::new(reference, gain), Seen::new(image, gain));
    let redistribution = colour::Redistribution::new();
    let difference = |index: usize| {
        let colour = redistribution.of(colour::hyab(reference.lab[index], image.lab[index]));
        let edge = (reference.edges[index] - image.edges[index]).abs();
        let point = (reference.points[index] - image.points[index]).abs();
        let feature = (edge.max(point) * std::f32::consts::FRAC_1_SQRT_2).min(1.0);
        // Section 5.3: features amplify a difference of colour.
        libm::powf(colour, 1.0 - libm::powf(feature, FEATURE_EXPONENT))
    };
    let map: Vec<f32> = (0..image.lab.len()).into_par_iter().map(difference).collect();
    let mean = map.iter().map(|&value| f64::from(value)).sum::<f64>() / map.len() as f64;
    Some(Flip { map, mean })
}

/// What is compared of an image, for each pixel.
struct Seen {
    /// Hunt-adjusted L*a*b* after the eye's contrast sensitivity has blurred it (section 5.1).
    lab: Vec<Vec3>,
    /// The length of the gradient of luminance (section 5.2).
    edges: Vec<f32>,
    /// The length of its second derivatives along x and y (section 5.2).
    points: Vec<f32>,
}

impl Seen {
    fn new(image: &Image, gain: f64) -> Self {
        let size = [image.width as usize, image.height as usize];
        // A NaN, which 0 · ∞ is, is not above 0.
        let shown = |value: f32| match f64::from(value) * gain {
            light if light > 0.0 => light.min(1.0) as f32,
            _ => 0.0,
        };
        let space = colour::Space::new();
        let opponent: Vec<Vec3> = image
            .pixels
            .par_iter()
            .map(|&pixel| space.opponent_from_rgb(Vec3::from(pixel.map(shown))))
            .collect();
        let plane = |value: fn(&Vec3) -> f32| Plane::new(size, opponent.iter().map(value));

        let [y, cx, cz] = filter::contrast_sensitivity();
        let y = filter::sum_of_gaussians(&plane(|c| c.x), &y);
        let cx = filter::sum_of_gaussians(&plane(|c| c.y), &cx);
        let cz = filter::sum_of_gaussians(&plane(|c| c.z), &cz);
        let blurred = |index: usize| {
            let opponent = Vec3::new(y.values[index], cx.values[index], cz.values[index]);
            let rgb = space.rgb_from_opponent(opponent).clamp(Vec3::ZERO, Vec3::ONE);
            colour::hunt(space.lab_from_rgb(rgb))
        };
        let lab = (0..opponent.len()).into_par_iter().map(blurred).collect();

        let luminance = plane(|c| (c.x + 16.0) / 116.0);
        let detectors = filter::feature_detectors();
        let magnitude = |kernel: &[f32]| {
            let along_x = filter::separable(&luminance, kernel, &detectors.gaussian);
            let along_y = filter::separable(&luminance, &detectors.gaussian, kernel);
            along_x
                .values
                .iter()
                .zip(&along_y.values)
                .map(|(&x, &y)| (x * x + y * y).sqrt())
                .collect()
        };
        Self { lab, edges: magnitude(&detectors.edge), points: magnitude(&detectors.point) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constant(value: f32) -> Image {
        Image { width: 9, height: 5, pixels: vec![[value; 3]; 45] }
    }

    #[test]
    fn what_is_equal_looks_equal() {
        let result = flip(&constant(0.5), &constant(0.5), 0.0).unwrap();
        assert_eq!((result.mean, result.map.len()), (0.0, 45));
        // Both are clamped to white.
        assert_eq!(flip(&constant(2.0), &constant(3.0), 0.0).unwrap().mean, 0.0);
        assert_eq!(flip(&constant(0.5), &constant(0.75), 1.0).unwrap().mean, 0.0);
    }

    #[test]
    fn black_and_white_differ_almost_wholly() {
        // HyAB is 100 here: 100^0.7 = 25.12 lies beyond the knee at 0.4 of the largest.
        let result = flip(&constant(0.0), &constant(1.0), 0.0).unwrap();
        assert!(result.map.iter().all(|&value| (value - 0.967).abs() < 1e-3), "{}", result.mean);
    }

    #[test]
    fn extremes_do_no_harm() {
        for exposure in [f32::MAX, f32::MIN, 0.0] {
            for value in [0.0, f32::MAX, -1.0, f32::NAN] {
                let result = flip(&constant(value), &constant(0.5), exposure).unwrap();
                assert!(result.map.iter().all(|value| (0.0..=1.0).contains(value)));
            }
        }
    }

    #[test]
    fn images_of_different_sizes_are_not_compared() {
        let other = Image { width: 5, height: 9, ..constant(0.5) };
        assert_eq!(flip(&constant(0.5), &other, 0.0), None);
        let empty = Image { width: 0, height: 0, pixels: Vec::new() };
        assert_eq!(flip(&empty, &empty, 0.0), None);
    }
}
