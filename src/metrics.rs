//! How far an image is from a reference: linear errors ([`Metrics`]) and a perceived one
//! ([`flip()`]), over all pixels or those that a mask keeps.

mod comparison;
mod flip;
mod linear;
mod mask;

pub use comparison::Comparison;
pub use flip::{Flip, flip};
pub use linear::Metrics;
pub use mask::away_from_bright;

/// The largest of some values, from 0 on; not a number if one of them is none, which `f64::max` would
/// pass over.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if a.is_nan() || a > b { a } else { b };
    values.into_iter().fold(0.0, larger)
}

#[cfg(test)]
mod tests {
    use super::largest;

    #[test]
    fn what_is_no_number_is_larger_than_all() {
        assert_eq!(largest([]), 0.0);
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        for at in 0..3 {
            let mut values = [1.0, 3.0, 2.0];
            values[at] = f64::NAN;
            assert!(largest(values).is_nan());
        }
    }
}
