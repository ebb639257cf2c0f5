//! How much of the reflected indirect light the bound on the geometry term took.

use std::time::Duration;

use crate::gpu::GpuError;
use crate::render::camera::Tile;
use crate::render::kernels::clamped_energy;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};

/// Sums, over the image, of the radiance that is reflected and of that which the clamp took.
#[derive(Debug)]
pub struct ClampedEnergy {
    /// Both, of each point of a tile.
    buffer: wgpu::Buffer,
    stage: Stage,
}

impl ClampedEnergy {
    /// For tiles of at most so many points; `compensated` is whether they have gathered what bias
    /// compensation gives back.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        tile: &[Named<'_>],
        points: usize,
        compensated: bool,
    ) -> Result<Self, GpuError> {
        let buffer = prepared.gpu.storage::<[f32; 2]>("energy", points)?;
        let named = [&[("energy", &buffer)], tile].concat();
        let stage = Stage::new(prepared, &clamped_energy(prepared.target(), compensated), &named)?;
        Ok(Self { buffer, stage })
    }

    /// Starts a tile anew.
    ///
    /// # Errors
    /// The device fails.
    pub fn clear(&self, prepared: &Prepared) -> Result<(), GpuError> {
        prepared.gpu.clear(&[&self.buffer])
    }

    /// Counts a sample of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn count(&self, prepared: &Prepared, tile: Tile) -> Result<Duration, GpuError> {
        self.stage.run(prepared, &(), [tile.blocks, 1])
    }

    /// Adds what a tile came to: radiance that was reflected, and that the clamp took.
    ///
    /// # Errors
    /// The device fails.
    pub fn add_to(
        &self,
        prepared: &Prepared,
        tile: Tile,
        sum: &mut [f64; 2],
    ) -> Result<(), GpuError> {
        let of_points: Vec<[f32; 2]> = prepared.gpu.read(&self.buffer, tile.points() as usize)?;
        for of_point in &of_points[tile.own()] {
            for (sum, value) in sum.iter_mut().zip(of_point) {
                *sum += f64::from(*value);
            }
        }
        Ok(())
    }
}
