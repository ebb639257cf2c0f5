//! Figures as text in tables.

use crate::study::results::Spread;

/// What stands where there is no value.
pub const NOTHING: &str = "–";

/// A value as `show` has it, or that there is none.
pub fn maybe<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or(NOTHING.to_owned(), show)
}

/// A mean and its standard deviation.
pub fn spread(value: Spread, show: fn(f64) -> String) -> String {
    match value.sd {
        Some(sd) => format!("{} ± {}", show(value.mean), show(sd)),
        None => show(value.mean),
    }
}

/// A count, where there is one.
pub fn count(value: Option<u64>) -> String {
    maybe(value, |value| value.to_string())
}

/// So many of what has a plural in s.
pub fn plural(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Seconds to the millisecond.
pub fn seconds(value: f64) -> String {
    format!("{value:.3}")
}

/// How many times.
pub fn factor(value: f64) -> String {
    format!("{value:.2}×")
}

/// A share.
pub fn percent(value: f64) -> String {
    format!("{:.2} %", 100.0 * value)
}

/// A share that may be below 0.
pub fn signed(value: f64) -> String {
    format!("{:+.3} %", 100.0 * value)
}

/// Three digits that count.
pub fn small(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 9.0);
    format!("{value:.0$}", digits as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        assert_eq!(small(0.00123456), "0.00123");
        assert_eq!(small(0.5), "0.500");
        assert_eq!(small(123.4), "123");
        assert_eq!(small(0.0), "0");
        let value = Spread { mean: 0.1, sd: Some(0.02) };
        assert_eq!(spread(value, seconds), "0.100 ± 0.020");
        assert_eq!(plural(1, "seed"), "1 seed");
    }
}
