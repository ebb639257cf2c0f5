//! Antialiasing: a few camera rays of every pixel find its visible point and its share of the light
//! of the points around; where surfaces of unlike radiance meet, more rays do.

use std::time::Duration;

use super::buffers::TileBuffers;
use super::setup::FrameSetup;
use crate::gpu::{CameraParams, GpuError};
use crate::render::kernels::{
    antialias, choose_points, chosen_points, first_rays, link_rays, rays_at_once, rays_of_beam,
};
use crate::render::prepared::Prepared;
use crate::render::stage::Stage;

/// First rays of a pixel over all its samples, unless the samples are more.
const MOST_FIRST: u32 = 4;

/// Most rays of a pixel in a dispatch: MOST_BEAMS of `shaders/camera/antialias.wgsl`, of four each.
const MOST_RAYS: u32 = 32;

/// The stages of antialiasing.
#[derive(Debug)]
pub struct Antialiasing {
    first: Stage,
    choose: Stage,
    chosen: Stage,
    link: Stage,
    antialias: Stage,
    /// Rays of a pixel in one dispatch, at most.
    rays_at_once: u32,
}

impl Antialiasing {
    /// For the tiles of a frame.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'_>, tile: &TileBuffers) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, .. } = *setup;
        let (gpu, points) = (&prepared.gpu, setup.most_points());
        let rays = MOST_FIRST as usize;
        let places = gpu.storage::<[u32; 4]>("places of rays", rays * points)?;
        let surfaces = gpu.storage::<[u32; 4]>("surfaces of rays", points)?;
        let choices = gpu.storage::<u32>("choices", points)?;
        let mut named = tile.named(prepared);
        named.extend([("ray_places", &places), ("ray_surfaces", &surfaces), ("choices", &choices)]);
        let bind = |program| Stage::new(prepared, &program, &named);
        let (target, emits) = (prepared.target_of(settings), prepared.lights.have_surfaces());
        Ok(Self {
            first: bind(first_rays(target, emits))?,
            choose: bind(choose_points())?,
            chosen: bind(chosen_points(target))?,
            link: bind(link_rays())?,
            antialias: bind(antialias(target, emits))?,
            rays_at_once: MOST_RAYS
                .min(rays_of_beam(target) * rays_at_once(prepared.bvh.nodes.len())),
        })
    }

    /// Finds the visible points of a tile, and what gives its light to each of the first rays.
    ///
    /// # Errors
    /// The device fails.
    pub fn find_points(
        &self,
        prepared: &Prepared,
        params: &CameraParams,
    ) -> Result<Duration, GpuError> {
        let stages = [&self.first, &self.choose, &self.chosen, &self.link];
        stages.into_iter().map(|stage| stage.run(prepared, params, [params.blocks, 1])).sum()
    }

    /// Adds the radiance of a sample of a tile to the film.
    ///
    /// # Errors
    /// The device fails.
    pub fn add_to_film(
        &self,
        prepared: &Prepared,
        params: &CameraParams,
    ) -> Result<Duration, GpuError> {
        let at_once = self.rays_at_once;
        let first = first_rays_of(params);
        let mut time = Duration::ZERO;
        // Once, even if there are no more rays.
        for first_ray in (first..params.edge_rays.max(first + 1)).step_by(at_once as usize) {
            let rays = at_once.min(params.edge_rays - first_ray);
            let params = CameraParams { first_ray, rays, ..*params };
            time += self.antialias.run(prepared, &params, [params.blocks, 1])?;
        }
        Ok(time)
    }
}

/// First rays of a sample of a pixel; the twin of `first_rays` in `shaders/camera/pixel_rays.wgsl`.
fn first_rays_of(params: &CameraParams) -> u32 {
    let most = MOST_FIRST.div_ceil(params.samples).min(params.edge_rays);
    1 << most.ilog2()
}
