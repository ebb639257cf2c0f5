//! Antialiasing: the first rays of all pixels, visible points of what is thinner than a pixel, and more
//! rays where surfaces of unlike radiance meet.

use std::time::Duration;

use super::buffers::TileBuffers;
use super::setup::FrameSetup;
use crate::gpu::{CameraParams, GpuError, TableFormat};
use crate::render::kernels::{
    antialias, first_rays, link_rays, rays_at_once, rays_of_beam, replace_points, resolve_rays,
    unseen_surfaces,
};
use crate::render::prepared::Prepared;
use crate::render::stage::Stage;

/// First rays of a pixel, over all its samples; twin of `MOST_FIRST` in
/// `shaders/camera/pixel_rays.wgsl`.
const MOST_FIRST: u32 = 4;
/// Most rays of a pixel in one dispatch: `MOST_BEAMS` of `shaders/camera/antialias.wgsl`, of four.
const MOST_RAYS: u32 = 32;

/// The stages of antialiasing.
#[derive(Debug)]
pub struct Antialiasing<'a> {
    prepared: &'a Prepared,
    first: Stage,
    unseen: Stage,
    replace: Stage,
    link: Stage,
    resolve: Stage,
    more: Stage,
    /// Rays of a pixel in one dispatch.
    at_once: u32,
}

impl<'a> Antialiasing<'a> {
    /// Binds what the settings need.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(setup: &FrameSetup<'a>, tile: &TileBuffers) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, .. } = *setup;
        let (target, emits) = (prepared.target_of(settings), prepared.lights.have_surfaces());
        let (gpu, points) = (&prepared.gpu, setup.most_points());
        let rays = points * MOST_FIRST as usize;
        let mut buffers = vec![
            ("ray_surfaces", gpu.storage::<[u32; 4]>("surfaces of rays", rays)?),
            ("ray_codes", gpu.storage::<u32>("links of rays", points)?),
            ("unseen", gpu.storage::<u32>("unseen surfaces", points)?),
            ("meetings", gpu.storage::<u32>("meetings of surfaces", points)?),
            ("ray_sums", gpu.storage::<[f32; 4]>("radiance of rays", points)?),
        ];
        if emits || target.features.sky.shines() {
            buffers.push(("ray_emission", gpu.storage::<[u32; 4]>("emission to rays", points)?));
        }
        if target.features.specular() {
            let throughputs = gpu.storage::<[f32; 4]>("throughputs of rays", rays)?;
            buffers.push(("ray_throughputs", throughputs));
        }
        let mut named = tile.named(prepared);
        named.extend(buffers.iter().map(|(name, buffer)| (*name, buffer)));
        let ranges = gpu.table("ranges of radiance", points, TableFormat::Quadruples)?;
        let mut textures = tile.textures();
        textures.extend([("ranges", &ranges), ("packed_ranges", &ranges)]);
        let bind = |program| Stage::with_textures(prepared, &program, &named, &textures);
        let at_once = rays_of_beam(target) * rays_at_once(prepared.bvh.nodes.len());
        Ok(Self {
            prepared,
            first: bind(first_rays(target, emits))?,
            unseen: bind(unseen_surfaces())?,
            replace: bind(replace_points())?,
            link: bind(link_rays(target, emits))?,
            resolve: bind(resolve_rays(target, emits))?,
            more: bind(antialias(target, emits))?,
            at_once: at_once.min(MOST_RAYS),
        })
    }

    /// Traces the first rays of a tile, and chooses those whose surfaces no pixel around shows: in
    /// `point_rays`, to replace visible points.
    ///
    /// # Errors
    /// The device fails.
    pub fn choose_points(&self, params: &CameraParams) -> Result<Duration, GpuError> {
        let mut time = Duration::ZERO;
        for stage in [&self.first, &self.unseen, &self.replace] {
            time += self.run(stage, params)?;
        }
        Ok(time)
    }

    /// Links the first rays of a tile to its visible points, once those are what they stay.
    ///
    /// # Errors
    /// The device fails.
    pub fn link(&self, params: &CameraParams) -> Result<Duration, GpuError> {
        self.run(&self.link, params)
    }

    /// Traces the first rays of a tile whose visible points are known.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace(&self, params: &CameraParams) -> Result<Duration, GpuError> {
        Ok(self.run(&self.first, params)? + self.link(params)?)
    }

    /// Brings what the first rays see to the film, and what more rays see where that differs.
    ///
    /// # Errors
    /// The device fails.
    pub fn add_to_film(&self, params: &CameraParams) -> Result<Duration, GpuError> {
        let mut time = self.run(&self.resolve, params)?;
        let first = MOST_FIRST.div_ceil(params.samples).min(params.edge_rays);
        for first_ray in (first..params.edge_rays).step_by(self.at_once as usize) {
            let rays = self.at_once.min(params.edge_rays - first_ray);
            time += self.run(&self.more, &CameraParams { first_ray, rays, ..*params })?;
        }
        Ok(time)
    }

    fn run(&self, stage: &Stage, params: &CameraParams) -> Result<Duration, GpuError> {
        stage.run(self.prepared, params, [params.blocks, 1])
    }
}
