//! What a study tells while it runs.

use super::measure::Measured;
use super::parts::Decomposition;
use crate::render::Settings;

/// What a study tells while it runs.
#[derive(Debug, Clone, Copy)]
pub enum Event<'a> {
    /// A part of a reference was rendered.
    Pass {
        /// The scene.
        scene: &'a str,
        /// Parts there are now.
        done: u32,
        /// Parts in all.
        passes: u32,
        /// What it took.
        seconds: f64,
    },
    /// A frame was rendered by which an error is taken apart.
    Part {
        /// The scene.
        scene: &'a str,
        /// How it was rendered.
        settings: &'a Settings,
        /// With which seed.
        seed: u32,
        /// What it took.
        seconds: f64,
    },
    /// An error was taken apart.
    Decomposed {
        /// The scene.
        scene: &'a str,
        /// How its image was rendered.
        settings: &'a Settings,
        /// With which seed.
        seed: u32,
        /// What was found.
        decomposition: &'a Decomposition,
        /// Whether an earlier run had found it.
        kept: bool,
    },
    /// A frame was measured.
    Frame {
        /// The scene.
        scene: &'a str,
        /// How it was rendered.
        settings: &'a Settings,
        /// With which seed.
        seed: u32,
        /// What was measured.
        measured: &'a Measured,
        /// Whether an earlier run had measured it.
        kept: bool,
    },
    /// Something is not as it should be.
    Warning(&'a str),
}

/// Told of events.
pub type Tell<'a> = &'a dyn Fn(Event<'_>);
