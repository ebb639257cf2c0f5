//! Camera rays of a tile: what they are drawn with, and the further ones at edges.

use std::time::Duration;

use super::film::Tile;
use super::tile::TileRenderer;
use super::{Prepared, kernels};
use crate::gpu::{CameraParams, GpuError};
use crate::sampling::{SURFACE_OFFSET, hash};
use crate::scene::Camera;

impl TileRenderer<'_> {
    pub(super) fn camera_params(&self, tile: Tile) -> CameraParams {
        CameraParams {
            first_block: tile.first_block,
            sample: tile.sample,
            blocks: tile.blocks,
            edge_rays: self.settings.edge_samples.div_ceil(self.settings.samples),
            ..camera_params(self.prepared, self.camera, self.settings.samples, self.seed)
        }
    }

    /// Brings the radiance of a sample to the film, with more camera rays at edges; nothing if
    /// it is there already.
    pub(super) fn antialias(&self, tile: Tile) -> Result<Duration, GpuError> {
        if let Some(stage) = &self.stages.resolve {
            return self.run(stage, &(), [tile.blocks, 1]);
        }
        let Some(stage) = &self.stages.antialias else { return Ok(Duration::ZERO) };
        let params = self.camera_params(tile);
        let at_once = kernels::rays_at_once(self.prepared.bvh.nodes.len());
        let mut time = Duration::ZERO;
        for first_ray in (0..params.edge_rays).step_by(at_once as usize) {
            let rays = at_once.min(params.edge_rays - first_ray);
            let params = CameraParams { first_ray, rays, ..params };
            time += self.run(stage, &params, [tile.blocks, 1])?;
        }
        Ok(time)
    }
}

/// What camera rays of all tiles share.
pub fn camera_params(
    prepared: &Prepared,
    camera: &Camera,
    samples: u32,
    seed: u32,
) -> CameraParams {
    let [x, y] = camera.half_tangents();
    CameraParams {
        position: camera.position.to_array(),
        width: camera.size[0],
        forward: camera.forward.to_array(),
        height: camera.size[1],
        right: (camera.right * x).to_array(),
        up: (camera.up * y).to_array(),
        samples,
        seed: hash(seed ^ 0x68e3_1da4),
        nodes: prepared.bvh.nodes.len() as u32,
        offset: SURFACE_OFFSET,
        ..bytemuck::Zeroable::zeroed()
    }
}
