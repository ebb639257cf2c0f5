//! The stiff and the extreme: cases in which a renderer fails first, each with what it must give.
//!
//! Rows (what goes wrong, and what is done about it) and cases (a scene, settings, and what the
//! image must be) are data: `tests/extremes/cases.toml`, read by [`Cases`]. A [`Runner`] renders
//! them, [`Judged`] is what came of a case, and [`table`] writes it down. [`checks`] look at what no
//! picture shows. All of it is part of the library, not of its tests, as users run it too: `gpu-vpl
//! study --preset extremes`.

mod bake;
mod cases;
pub mod checks;
mod figure;
mod front;
mod judge;
mod runner;
mod scale;
mod shapes;
mod staging;
pub mod table;

pub use bake::Bake;
pub use cases::{CASES, Case, Cases, Expect, Like, Own, Radiance, Row, SceneText};
pub use figure::Figure;
pub use front::{Asked, Front};
pub use runner::{Judged, Runner, Verdict};
pub use scale::Scale;

/// The name of the preset.
pub const NAME: &str = "extremes";
