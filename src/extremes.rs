//! The stiff and the extreme: cases in which a renderer fails first, each with what it must give.
//!
//! Rows (what goes wrong, and what is done about it) and cases (a scene, settings, and what the
//! image must be) are data: `tests/extremes/cases.toml`, read by [`Cases`]. A [`Runner`] renders
//! them, [`Judged`] is what came of a case, and [`table`] writes it down.

mod bake;
mod cases;
pub mod checks;
mod judge;
mod runner;
mod shapes;
mod stage;
pub mod table;

use serde::{Deserialize, Serialize};

pub use bake::Bake;
pub use cases::{CASES, Case, Cases, Expect, Like, Own, Radiance, Row, SceneText};
pub use runner::{Judged, Runner, Verdict};
pub use stage::{Asked, Front};

/// The name of the preset.
pub const NAME: &str = "extremes";

/// How large cases are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// For tests: seconds in all.
    Small,
    /// For publication.
    Full,
}

/// A measured figure beside what it must be.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// The method that it is of; empty where it is of none.
    pub method: String,
    /// What was measured, in a few words, with its setting.
    pub what: String,
    /// What it must be.
    pub expected: f64,
    /// What it is.
    pub measured: f64,
    /// How far it is off, in the unit of `within`: absolute, or relative to what is expected.
    pub error: f64,
    /// How far it may be off.
    pub within: f64,
}

impl Figure {
    /// Whether the figure is right. What is not a number is not.
    pub fn holds(&self) -> bool {
        self.measured.is_finite() && self.error <= self.within
    }
}
