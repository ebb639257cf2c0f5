//! What the camera sees by itself: emission of surfaces and of the environment; or, in methods
//! without light, the data that they show.

use std::time::Duration;

use super::buffers::TileBuffers;
use super::setup::FrameSetup;
use super::tiling::Tile;
use crate::gpu::GpuError;
use crate::render::kernels::show;
use crate::render::prepared::Prepared;
use crate::render::stage::Stage;

/// The stages of what is seen without any light on it.
#[derive(Debug)]
pub struct Emission<'a> {
    prepared: &'a Prepared,
    stages: Vec<Stage>,
}

impl<'a> Emission<'a> {
    /// Binds what the settings need.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'a>, tile: &TileBuffers) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, .. } = *setup;
        let named = tile.named_by_point(prepared);
        let programs = match settings.method.is_lit() {
            // Each camera ray sees its own.
            true if settings.antialiases() => Vec::new(),
            true => prepared.emission_programs(),
            false => show(prepared.target(), settings.method).into_iter().collect(),
        };
        let stages = programs.iter().map(|program| Stage::new(prepared, program, &named));
        Ok(Self { prepared, stages: stages.collect::<Result<_, _>>()? })
    }

    /// Adds it to the radiance of the visible points of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn add(&self, tile: Tile) -> Result<Duration, GpuError> {
        let times = self.stages.iter().map(|stage| stage.run(self.prepared, &(), [tile.blocks, 1]));
        times.sum()
    }
}
