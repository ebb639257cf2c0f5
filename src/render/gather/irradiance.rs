//! What visible points gather of one kind of light, and what they reflect of it.

use std::time::Duration;

use crate::gpu::GpuError;
use crate::render::camera::{FrameSetup, Tile, TileBuffers};
use crate::render::kernels::reflect;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};

/// Irradiance of the visible points of a tile.
#[derive(Debug)]
pub struct Irradiance {
    /// Of the kind of light that is being gathered; of each lobe.
    pub buffer: wgpu::Buffer,
    reflect: Stage,
}

impl Irradiance {
    /// For the tiles of a frame.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'_>, tile: &TileBuffers) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, .. } = *setup;
        let target = prepared.target_of(settings);
        let values = setup.most_points() * target.lobes();
        let buffer = prepared.gpu.storage::<[f32; 4]>("irradiance", values)?;
        let mut named = tile.named_by_point(prepared);
        named.push(("irradiance", &buffer));
        let reflect = Stage::new(prepared, &reflect(target), &named)?;
        Ok(Self { buffer, reflect })
    }

    /// It, by name.
    pub fn named(&self) -> Named<'_> {
        ("irradiance", &self.buffer)
    }

    /// Forgets what was gathered last.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear(&self, prepared: &Prepared) -> Result<(), GpuError> {
        prepared.gpu.clear(&[&self.buffer])
    }

    /// Adds what the visible points of a tile reflect of it to their radiance.
    ///
    /// # Errors
    /// The device fails.
    pub fn reflect(&self, prepared: &Prepared, tile: Tile) -> Result<Duration, GpuError> {
        self.reflect.run(prepared, &(), [tile.blocks, 1])
    }
}
