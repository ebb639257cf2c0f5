//! Light of the real lights, from each visible point of a tile.

use std::time::Duration;

use super::film::Tile;
use super::kernels;
use super::tile::TileRenderer;
use super::visibility::dispatch_rays;
use crate::gpu::{DirectParams, GpuError};
use crate::sampling::{SURFACE_OFFSET, hash};

impl TileRenderer<'_> {
    /// Direct light, in dispatches of a bounded number of shadow rays.
    pub(super) fn direct(&self, tile: Tile) -> Result<Duration, GpuError> {
        let most = kernels::rays_at_once(self.prepared.bvh.nodes.len());
        let slice = (dispatch_rays(self.prepared) / tile.points()).clamp(1, most);
        let mut time = Duration::ZERO;
        for (kind, stage) in &self.stages.direct {
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
                time += self.run(stage, &params, [tile.blocks, 1])?;
            }
        }
        Ok(time)
    }
}
