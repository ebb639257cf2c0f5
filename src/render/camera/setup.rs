//! What every step of a frame is made for: scene, camera, settings, tiles.

use super::tiling::Tiling;
use crate::render::prepared::Prepared;
use crate::render::settings::Settings;
use crate::scene::Camera;

/// A scene, a view of it, how it is rendered, and in which tiles.
#[derive(Debug, Clone, Copy)]
pub struct FrameSetup<'a> {
    /// The scene on the device.
    pub prepared: &'a Prepared,
    /// Where it is seen from.
    pub camera: &'a Camera,
    /// How it is rendered.
    pub settings: &'a Settings,
    /// Of all random numbers.
    pub seed: u32,
    /// How the image makes tiles.
    pub tiling: Tiling,
}

impl<'a> FrameSetup<'a> {
    /// With tiles that suit the settings.
    pub fn new(
        prepared: &'a Prepared,
        camera: &'a Camera,
        settings: &'a Settings,
        seed: u32,
    ) -> Self {
        Self { prepared, camera, settings, seed, tiling: Tiling::of(camera, settings) }
    }

    /// Points of a tile, at most.
    pub fn most_points(&self) -> usize {
        self.tiling.most_points() as usize
    }
}
