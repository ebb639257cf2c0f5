//! What a comparison may find without failing.

use clap::Args;

use crate::cli::parse;
use crate::metrics::Comparison;

/// The largest errors allowed; with any of them, pixels that are not finite fail too.
#[derive(Debug, Args)]
pub struct Limits {
    /// Fail with code 4 if rmse is over this
    #[arg(long, value_name = "X", value_parser = parse::limit, allow_hyphen_values = true)]
    max_rmse: Option<f64>,

    /// Fail with code 4 if relmse is over this
    #[arg(long, value_name = "X", value_parser = parse::limit, allow_hyphen_values = true)]
    max_relmse: Option<f64>,

    /// Fail with code 4 if flip is over this
    #[arg(long, value_name = "X", value_parser = parse::limit, allow_hyphen_values = true)]
    max_flip: Option<f64>,

    /// Fail with code 4 if bias, of either sign, is over this; 0.01 is one percent
    #[arg(long, value_name = "X", value_parser = parse::limit, allow_hyphen_values = true)]
    max_bias: Option<f64>,
}

impl Limits {
    /// Whether there is any.
    pub fn any(&self) -> bool {
        [self.max_rmse, self.max_relmse, self.max_flip, self.max_bias].iter().any(Option::is_some)
    }

    /// Each limit that is exceeded, in words. What is not a number exceeds every limit.
    pub fn exceeded(&self, comparison: &Comparison) -> Vec<String> {
        let Comparison { metrics, flip, .. } = comparison;
        let rows = [
            ("rmse", metrics.rmse, self.max_rmse),
            ("relmse", metrics.relmse, self.max_relmse),
            ("flip", *flip, self.max_flip),
            ("bias", metrics.bias, self.max_bias),
        ];
        let over = |(name, value, limit): (&str, f64, Option<f64>)| {
            let limit = limit?;
            let within = value.abs() <= limit;
            (!within).then(|| format!("{name} {value:?} is over --max-{name} {limit:?}"))
        };
        rows.into_iter().filter_map(over).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::Metrics;

    fn exceeded(bias: f64, rmse: f64) -> Vec<String> {
        let metrics = Metrics { bias, rmse, ..Metrics::default() };
        let comparison = Comparison { metrics, flip: 0.0, nonfinite: 0, flip_map: Vec::new() };
        let limits = Limits {
            max_rmse: Some(0.5),
            max_relmse: None,
            max_flip: Some(0.0),
            max_bias: Some(0.01),
        };
        limits.exceeded(&comparison)
    }

    #[test]
    fn only_what_is_over_its_limit_is_named() {
        assert!(exceeded(-0.01, 0.5).is_empty());
        assert_eq!(exceeded(-0.02, 0.5), ["bias -0.02 is over --max-bias 0.01"]);
        assert_eq!(exceeded(0.02, 0.75).len(), 2);
    }

    #[test]
    fn what_is_not_a_number_is_over_every_limit() {
        assert_eq!(exceeded(f64::NAN, f64::INFINITY).len(), 2);
    }
}
