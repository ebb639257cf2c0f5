//! A measured figure beside what it must be.

use serde::{Deserialize, Serialize};

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
