//! What is known of a scene so far.

use super::measure::Measured;
use super::{Reference, Transport};
use crate::render::Settings;

/// What is known of a scene so far.
#[derive(Debug)]
pub struct Found {
    /// Its name.
    pub scene: String,
    /// Its triangles.
    pub triangles: usize,
    /// Width and height of its frames.
    pub size: [u32; 2],
    /// At which FLIP looks.
    pub exposure: f32,
    /// One for each kind of transport; or one for all.
    pub references: Vec<Reference>,
    /// In the order of measuring.
    pub frames: Vec<FoundFrame>,
}

/// A measured frame.
#[derive(Debug, Clone)]
pub struct FoundFrame {
    /// How it was rendered.
    pub settings: Settings,
    /// With which seed.
    pub seed: u32,
    /// What was measured.
    pub measured: Measured,
    /// The name of its image in the store.
    pub image: String,
}

impl Found {
    /// The reference that frames of these settings are compared with.
    pub fn reference(&self, settings: &Settings) -> Option<&Reference> {
        let transport = Transport::of(settings);
        self.references.iter().find(|reference| reference.transport.is_none_or(|t| t == transport))
    }
}
