//! A figure over several seeds.

use serde::Serialize;

/// A mean over seeds and the standard deviation of a single one; null for one seed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[expect(missing_docs, reason = "the keys are the names")]
pub struct Spread {
    pub mean: f64,
    pub sd: Option<f64>,
}

impl Spread {
    /// The mean of values and their standard deviation; they are not empty.
    pub fn of(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        Self { mean, sd: (values.len() > 1).then(|| (squares / (count - 1.0)).sqrt()) }
    }

    /// The root of the mean of squares in the place of the mean.
    pub(super) fn of_roots(values: &[f64]) -> Self {
        let squares = values.iter().map(|value| value * value).sum::<f64>();
        Self { mean: (squares / values.len() as f64).sqrt(), ..Self::of(values) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spreads_are_means_with_standard_deviations() {
        assert_eq!(Spread::of(&[2.0]), Spread { mean: 2.0, sd: None });
        let spread = Spread::of(&[1.0, 3.0, 5.0]);
        assert_eq!(spread, Spread { mean: 3.0, sd: Some(2.0) });
        assert_eq!(Spread::of_roots(&[3.0, 4.0]).mean, 12.5f64.sqrt());
    }
}
