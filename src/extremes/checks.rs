//! Checks of what no picture shows: of rays, sums and clusters by themselves.

mod builder;
mod clamp;
mod clusters;
mod dark;
mod flux;
pub mod gather;
mod input;
mod measure;
pub mod random;
pub mod rays;
mod same;
mod sums;
pub mod trace;

use super::{Figure, Scale};
use crate::error::Error;
use crate::gpu::Gpu;

/// Measures something and says what it must be.
pub type Check = fn(&Gpu, Scale) -> Result<Vec<Figure>, Error>;

/// All of them, by the names under which the cases know them.
pub const CHECKS: &[(&str, Check)] = &[
    ("leaks-of-closed-surfaces", rays::leaks),
    ("rays-in-faces-of-boxes", rays::in_faces),
    ("dark-room", dark::rooms),
    ("sphere-of-vpls", sums::in_a_sphere),
    ("vpl-at-point", sums::at_the_point),
    ("many-vpl-terms", sums::many_terms),
    ("form-factors", flux::form_factors),
    ("flux", flux::kept),
    ("kmeans-corners", clusters::corners),
    ("fuzzy-weights", clusters::weights),
    ("clusters-of-one", clusters::of_one),
    ("same-bytes", same::bytes),
    ("clamp-scale-free", clamp::scale_free),
    ("clamp-vanishes", clamp::vanishes),
    ("clamped-fraction", clamp::fraction),
    ("non-finite-counted", input::counted),
    ("refused-input", input::refused),
];
