//! Light of the real lights, from each visible point of a tile.

use std::time::Duration;

use super::camera::{FrameSetup, Tile, TileBuffers};
use super::gather::Irradiance;
use super::kernels::rays_at_once;
use super::lights::LightKind;
use super::prepared::Prepared;
use super::settings::{Direct, Settings};
use super::stage::Stage;
use super::visibility::dispatch_rays;
use crate::gpu::{DirectParams, GpuError};
use crate::sampling::{SURFACE_OFFSET, hash};

/// Shadow rays from every visible point to the lights.
#[derive(Debug)]
pub struct DirectLight<'a> {
    prepared: &'a Prepared,
    settings: &'a Settings,
    seed: u32,
    /// A stage for each kind of lights.
    stages: Vec<(LightKind, Stage)>,
}

impl<'a> DirectLight<'a> {
    /// Binds what the settings need: nothing without direct light.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        tile: &TileBuffers,
        irradiance: Option<&Irradiance>,
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, seed, .. } = *setup;
        let mut named = tile.named_by_point(prepared);
        named.extend(irradiance.map(Irradiance::named));
        let mut stages = Vec::new();
        for (kind, table) in &prepared.light_tables {
            if is_per_pixel(settings, *kind) {
                let named = [&named[..], &[("lights", table)]].concat();
                let stage = Stage::new(prepared, &prepared.direct_program(*kind), &named)?;
                stages.push((*kind, stage));
            }
        }
        Ok(Self { prepared, settings, seed, stages })
    }

    /// Whether there is none to gather.
    pub fn is_empty(&self) -> bool {
        self.stages.is_empty()
    }

    /// Adds it to the irradiance of the visible points of a tile, in dispatches of a bounded number
    /// of shadow rays.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather(&self, tile: Tile) -> Result<Duration, GpuError> {
        let most = rays_at_once(self.prepared.bvh.nodes.len());
        let slice = (dispatch_rays(self.prepared) / tile.points()).clamp(1, most);
        let mut time = Duration::ZERO;
        for (kind, stage) in &self.stages {
            let lights = self.prepared.lights.count(*kind);
            if lights == 0 {
                continue;
            }
            let rays = match kind.is_exact() {
                true => lights,
                false => self.settings.light_samples_per_point(),
            };
            for start in (0..rays).step_by(slice as usize) {
                let params = DirectParams {
                    points: tile.points(),
                    lights,
                    first: start,
                    count: slice.min(rays - start),
                    seed: hash(self.seed),
                    first_block: tile.first_block,
                    offset: SURFACE_OFFSET,
                    nodes: self.prepared.bvh.nodes.len() as u32,
                    sample: tile.sample,
                    samples: self.settings.samples,
                    weight: 1.0 / (rays as f32 * self.settings.samples as f32),
                    share: 1.0 / rays as f32,
                };
                time += stage.run(self.prepared, &params, [tile.blocks, 1])?;
            }
        }
        Ok(time)
    }
}

/// Whether every visible point has its own shadow rays to the lights of a kind. Clusters share the
/// visibility of lights that have places; the others are exact.
fn is_per_pixel(settings: &Settings, kind: LightKind) -> bool {
    match settings.direct {
        _ if !settings.method.is_lit() => false,
        Direct::PerPixel => true,
        Direct::Clustered => !kind.has_places(),
        Direct::Off => false,
    }
}
