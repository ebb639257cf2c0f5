//! Camera rays: the visible points of a tile, and further rays at edges.

use std::time::Duration;

use super::buffers::TileBuffers;
use super::setup::FrameSetup;
use super::tiling::Tile;
use crate::gpu::{CameraParams, GpuError};
use crate::render::kernels::{antialias, rays_at_once, resolve, visible_points};
use crate::render::prepared::Prepared;
use crate::render::stage::Stage;
use crate::sampling::{SURFACE_OFFSET, hash};
use crate::scene::Camera;

/// The camera rays of a frame.
#[derive(Debug)]
pub struct CameraRays<'a> {
    prepared: &'a Prepared,
    /// What all tiles share.
    params: CameraParams,
    visible: Stage,
    film: ToFilm,
}

/// How the radiance of a sample's visible points comes to the film.
#[derive(Debug)]
enum ToFilm {
    /// It is there.
    Direct,
    /// Through mirrors and glass.
    Resolved(Stage),
    /// With further camera rays where pixels see edges.
    Antialiased(Stage),
}

impl<'a> CameraRays<'a> {
    /// Binds what the settings need.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'a>, tile: &TileBuffers) -> Result<Self, GpuError> {
        let FrameSetup { prepared, camera, settings, seed, .. } = *setup;
        let target = prepared.target_of(settings);
        let named = tile.named(prepared);
        let bind = |program| Stage::new(prepared, &program, &named);
        let film = match settings.antialiases() {
            true => ToFilm::Antialiased(bind(antialias(target))?),
            false if target.features.specular() => ToFilm::Resolved(bind(resolve(target))?),
            false => ToFilm::Direct,
        };
        let params = CameraParams {
            edge_rays: settings.edge_samples.div_ceil(settings.samples),
            ..camera_params(prepared, camera, settings.samples, seed)
        };
        let visible = bind(visible_points(target, settings.method.is_lit()))?;
        Ok(Self { prepared, params, visible, film })
    }

    /// Finds the visible points of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn find_points(&self, tile: Tile) -> Result<Duration, GpuError> {
        self.visible.run(self.prepared, &self.params_of(tile), [tile.blocks, 1])
    }

    /// Brings the radiance of a sample to the film, with more camera rays at edges; nothing if
    /// it is there already.
    ///
    /// # Errors
    /// The device fails.
    pub fn add_to_film(&self, tile: Tile) -> Result<Duration, GpuError> {
        let groups = [tile.blocks, 1];
        match &self.film {
            ToFilm::Direct => Ok(Duration::ZERO),
            ToFilm::Resolved(stage) => stage.run(self.prepared, &(), groups),
            ToFilm::Antialiased(stage) => {
                let params = self.params_of(tile);
                let at_once = rays_at_once(self.prepared.bvh.nodes.len());
                let mut time = Duration::ZERO;
                for first_ray in (0..params.edge_rays).step_by(at_once as usize) {
                    let rays = at_once.min(params.edge_rays - first_ray);
                    let params = CameraParams { first_ray, rays, ..params };
                    time += stage.run(self.prepared, &params, groups)?;
                }
                Ok(time)
            }
        }
    }

    fn params_of(&self, tile: Tile) -> CameraParams {
        CameraParams {
            first_block: tile.first_block,
            sample: tile.sample,
            blocks: tile.blocks,
            ..self.params
        }
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
