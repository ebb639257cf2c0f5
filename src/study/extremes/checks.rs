//! Checks of what no picture shows: of rays, sums and clusters by themselves.

mod measure;
pub mod random;
mod rays;
pub mod trace;

use super::{Figure, Scale};
use crate::error::Error;
use crate::gpu::Gpu;

/// Measures something and says what it must be.
pub type Check = fn(&Gpu, Scale) -> Result<Vec<Figure>, Error>;

/// All of them, by the names under which the cases know them.
pub const CHECKS: &[(&str, Check)] =
    &[("leaks-of-closed-surfaces", rays::leaks), ("rays-in-faces-of-boxes", rays::in_faces)];
