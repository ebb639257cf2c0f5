//! Terms that an error is the sum of, as images.

use crate::image::Image;
use crate::metrics::Metrics;
use crate::study::parts::{Decomposition, Left, Part, Replaced};

/// A converged estimate is made from so many times the samples of the one that tells its noise.
pub const FEWER: u32 = 4;

/// An image, or a difference of images, a value for each channel of each pixel; and what the same
/// estimate from a quarter of the samples is off by. That is noise of variance σ²/(n/4) against
/// σ²/n: three times the variance of the estimate itself where the first samples are among all,
/// five times where they are others, and more where error falls faster than variance does.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    value: Vec<f32>,
    doubt: Vec<f32>,
}

impl Estimate {
    /// An image as it is.
    pub fn exact(image: &Image) -> Self {
        // As metrics do: what is not finite is 0.
        let finite = |value: &f32| if value.is_finite() { *value } else { 0.0 };
        let value: Vec<_> = image.pixels.as_flattened().iter().map(finite).collect();
        Self { doubt: vec![0.0; value.len()], value }
    }

    /// From an estimate of many samples, and one of a quarter of these.
    pub fn converged(many: Self, few: &Self) -> Self {
        let doubt = combined(&few.value, &many.value, -1.0);
        Self { doubt, ..many }
    }

    /// The sum of two, the second times a factor.
    pub fn plus(&self, factor: f32, other: &Self) -> Self {
        Self {
            value: combined(&self.value, &other.value, factor),
            doubt: combined(&self.doubt, &other.doubt, factor),
        }
    }

    /// The difference of two.
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(-1.0, other)
    }
}

fn combined(one: &[f32], other: &[f32], factor: f32) -> Vec<f32> {
    one.iter().zip(other).map(|(one, other)| one + factor * other).collect()
}

/// Takes the error of an image against a reference apart. Terms are what the image is off by on
/// account of a part; with indirect light, what they leave is the VPLs' own.
/// None if sizes differ or there is no pixel to compare.
pub fn decomposition(
    reference: &Image,
    keep: &[bool],
    image: &Estimate,
    mut terms: Vec<(Part, Estimate)>,
    indirect: bool,
) -> Option<Decomposition> {
    let base = Estimate::exact(reference);
    let error = image.minus(&base);
    let sum = |of: &[(Part, Estimate)]| {
        let zero = base.minus(&base);
        of.iter().fold(zero, |sum, (_, term)| sum.plus(1.0, term))
    };
    let all = sum(&terms);
    if indirect {
        let is_film = |part: &Part| matches!(part, Part::Direct | Part::Antialiasing);
        let film: Vec<_> = terms.iter().filter(|(part, _)| is_film(part)).cloned().collect();
        terms.push((Part::Indirect, error.minus(&sum(&film))));
        terms.push((Part::Vpls, error.minus(&all)));
    }
    terms.push((Part::All, all));
    let clean = image_of(&base.value, reference);
    let left = |off: &[f32]| {
        let image = image_of(&combined(&base.value, off, 1.0), reference);
        let metrics = Metrics::masked(&image, &clean, keep)?;
        Some(Left { relmse: metrics.relmse, bias: metrics.bias })
    };
    let replaced = |(part, term): &(Part, Estimate)| {
        let rest = error.minus(term);
        let noise = left(&rest.doubt)?.relmse / f64::from(FEWER - 1);
        Some(Replaced { part: *part, left: left(&rest.value)?, noise })
    };
    let mut parts: Vec<_> = terms.iter().map(replaced).collect::<Option<_>>()?;
    parts.sort_by_key(|replaced| Part::ALL.iter().position(|part| *part == replaced.part));
    Some(Decomposition { whole: left(&error.value)?, parts })
}

/// An image of these values, in the size of another.
fn image_of(values: &[f32], like: &Image) -> Image {
    let pixels = values.chunks_exact(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    Image { width: like.width, height: like.height, pixels }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Part::{All, Antialiasing, Direct, Indirect, Vpls};

    fn exact(values: [f32; 2]) -> (Image, Estimate) {
        let image = Image { width: 2, height: 1, pixels: values.map(|value| [value; 3]).into() };
        let estimate = Estimate::exact(&image);
        (image, estimate)
    }

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-6
    }

    #[test]
    fn what_is_replaced_is_gone_and_the_rest_stays() {
        // relMSE divides by 4 (1 + 0.01).
        let per = |squares: f64| squares / 2.0 / 4.04;
        let (reference, _) = exact([2.0, 2.0]);
        let (_, image) = exact([3.0, 0.0]);
        let zero = image.minus(&image);
        let direct = Estimate { value: [[1.0; 3], [0.0; 3]].as_flattened().into(), ..zero.clone() };
        let film = Estimate { value: [[0.0; 3], [-0.5; 3]].as_flattened().into(), ..zero };
        let terms = vec![(Direct, direct), (Antialiasing, film)];
        let found = decomposition(&reference, &[true; 2], &image, terms.clone(), true).unwrap();
        let left = |part| found.parts.iter().find(|own| own.part == part).unwrap().left;
        assert!(close(found.whole.relmse, per(5.0)) && close(found.whole.bias, -0.25));
        assert!(close(left(Direct).relmse, per(4.0)));
        assert!(close(left(Antialiasing).relmse, per(1.0 + 1.5 * 1.5)));
        assert!(close(left(Vpls).relmse, per(1.0 + 0.25)));
        assert!(close(left(All).relmse, per(1.5 * 1.5)));
        assert_eq!(left(Indirect), left(Vpls));
        let order: Vec<_> = found.parts.iter().map(|own| own.part).collect();
        assert_eq!(order, [Direct, Indirect, Antialiasing, Vpls, All]);
        let masked = decomposition(&reference, &[true, false], &image, terms, false).unwrap();
        assert!(close(masked.whole.relmse, 1.0 / 4.04) && masked.parts.len() == 3);
    }

    #[test]
    fn noise_that_two_terms_share_cancels_where_both_are_replaced() {
        let (reference, zero) = exact([0.0, 2.0]);
        let zero = zero.minus(&zero);
        let (_, few) = exact([0.0, 2.3]);
        let light = Estimate::converged(exact([0.0, 2.0]).1, &few);
        let terms = vec![(Direct, zero.minus(&light)), (Antialiasing, light)];
        let image = Estimate::exact(&reference);
        let found = decomposition(&reference, &[true; 2], &image, terms, false).unwrap();
        let noise: Vec<_> = found.parts.iter().map(|own| own.noise).collect();
        let one = 0.3 * 0.3 / 4.01 / 2.0 / 3.0;
        assert!(close(noise[0], one) && close(noise[1], one) && noise[2] == 0.0, "{noise:?}");
    }
}
