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
