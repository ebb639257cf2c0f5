//! Probes: a few lights that tell where a point sees otherwise than its cluster does.

use std::time::Instant;

use super::light_set::LightSet;
use super::trace::Tracer;
use crate::gpu::{GpuError, VisibilityParams};
use crate::render::prepared::Prepared;
use crate::render::result::Phases;
use crate::render::stage::{Named, Stage};

/// A few lights to each of which every point traces a shadow ray.
#[derive(Debug)]
pub struct Probes<'a> {
    prepared: &'a Prepared,
    tracer: Tracer<'a>,
    count: u32,
    stage: Stage,
    bits: wgpu::Buffer,
}

impl<'a> Probes<'a> {
    /// Up to 32 lights, for tiles of at most so many points.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &'a Prepared,
        lights: &LightSet,
        tile: &[Named<'_>],
        points: u32,
    ) -> Result<Self, GpuError> {
        let tracer = Tracer::new(prepared, 1)?;
        let bits = prepared.gpu.storage::<u32>("signatures", points as usize)?;
        let own = [("vpls", &lights.buffer), ("bits", &bits)];
        let stage = tracer.stage(lights.emitter, &[&own[..], tile].concat())?;
        Ok(Self { prepared, tracer, count: lights.count, stage, bits })
    }

    /// Which of them the points of a tile see, a bit each; and the rays traced.
    ///
    /// # Errors
    /// The device fails.
    pub fn seen(&self, points: u32, phases: &mut Phases) -> Result<(Vec<u32>, u64), GpuError> {
        let params = VisibilityParams { vpls: self.count, ..self.tracer.params(points, 0, 1) };
        let rays = self.tracer.trace(&self.stage, params, 1, phases, &|_| {})?;
        let start = Instant::now();
        let bits = self.prepared.gpu.read(&self.bits, points as usize)?;
        phases.readback += start.elapsed();
        Ok((bits, rays))
    }
}
