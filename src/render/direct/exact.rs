//! Lights without extent: a ray to each tells all.

use std::time::Duration;

use super::dispatches::rays_of_dispatch;
use crate::gpu::{DirectParams, GpuError};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::lights::LightKind;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};
use crate::sampling::{SURFACE_OFFSET, hash};

/// Shadow rays to the lights of a kind.
#[derive(Debug)]
pub struct ExactLight<'a> {
    prepared: &'a Prepared,
    /// What all tiles share.
    params: DirectParams,
    stage: Stage,
}

impl<'a> ExactLight<'a> {
    /// Binds the lights of a kind and the buffers of a tile.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        kind: LightKind,
        named: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, seed, .. } = *setup;
        let lights = prepared.exact_lights(kind);
        let program = prepared.direct_exact_program(kind);
        let stage = Stage::new(prepared, &program, &[&lights[..], named].concat())?;
        let count = prepared.lights.count(kind);
        let params = DirectParams {
            lights: count,
            rays: count,
            most_rays: count,
            samples: settings.samples,
            seed: hash(seed),
            offset: SURFACE_OFFSET,
            nodes: prepared.bvh.nodes.len() as u32,
            ..bytemuck::Zeroable::zeroed()
        };
        Ok(Self { prepared, params, stage })
    }

    /// Adds their light to the irradiance of the visible points of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather(&self, tile: Tile) -> Result<Duration, GpuError> {
        rays_of_dispatch(self.prepared, tile, self.params)
            .map(|params| self.stage.run(self.prepared, &params, [tile.blocks, 1]))
            .sum()
    }
}
