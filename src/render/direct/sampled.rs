//! Lights of some extent: a few rays to places that the guide chooses.

use std::time::Duration;

use super::filter::DirectFilter;
use super::guide::Guide;
use crate::gpu::{DirectParams, GpuError};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::kernels::rays_at_once;
use crate::render::lights::LightKind;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};
use crate::render::visibility::dispatch_rays;
use crate::sampling::{SURFACE_OFFSET, hash};

/// As `MOST` of `shaders/direct/ray_counts.wgsl`.
const MOST_TIMES: u32 = 4;

/// So many samples of a pixel are stratified better than a choice among candidates leaves them.
const STRATIFIED: u32 = 64;

/// Shadow rays to all lights that have some extent.
#[derive(Debug)]
pub struct SampledLight<'a> {
    prepared: &'a Prepared,
    /// What all tiles share.
    params: DirectParams,
    most_rays: u32,
    guide: Guide<'a>,
    filter: Option<DirectFilter<'a>>,
    stage: Stage,
}

impl<'a> SampledLight<'a> {
    /// Binds the lights of these kinds and the buffers of a tile.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        kinds: &[LightKind],
        irradiance: Named<'_>,
        named: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, seed, .. } = *setup;
        let strata = prepared.lights.strata(kinds);
        let table = prepared.gpu.storage_of("strata of the lights", &strata.records)?;
        let named = [&[("light_strata", &table)], named].concat();
        let [unshadowed, pilot, guide, samples] = prepared.direct_sampled_programs(kinds, settings);
        let programs = [&unshadowed, &pilot, &guide];
        let guide = Guide::new(setup, &strata, programs, &named)?;
        let rays = settings.light_samples_per_point();
        let filter = settings.filters_direct();
        let filter =
            filter.then(|| DirectFilter::new(setup, rays, irradiance, &named)).transpose()?;
        let mut named = [&guide.named()[..], &named].concat();
        named.extend(filter.iter().map(|filter| ("ray_counts", &filter.ray_counts)));
        let params = DirectParams {
            lights: strata.records.len() as u32,
            rays,
            candidates: if rays * settings.samples < STRATIFIED { 2 } else { 1 },
            samples: settings.samples,
            seed: hash(seed),
            offset: SURFACE_OFFSET,
            nodes: prepared.bvh.nodes.len() as u32,
            ..bytemuck::Zeroable::zeroed()
        };
        Ok(Self {
            stage: Stage::new(prepared, &samples, &named)?,
            // Where pixels have few like neighbours, they take more.
            most_rays: if settings.counts_light_samples() { MOST_TIMES * rays } else { rays },
            prepared,
            params,
            guide,
            filter,
        })
    }

    /// Adds their light to the irradiance of the visible points of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn gather(&self, tile: Tile) -> Result<Duration, GpuError> {
        let mut time = Duration::ZERO;
        if tile.sample == 0 {
            time += self.guide.make(tile)?;
        }
        if let Some(filter) = &self.filter {
            time += filter.count(tile)?;
        }
        for params in rays_of_dispatch(self.prepared, tile, self.params, self.most_rays) {
            time += self.stage.run(self.prepared, &params, [tile.blocks, 1])?;
        }
        if let Some(filter) = &self.filter {
            time += filter.combine(tile)?;
        }
        Ok(time)
    }
}

/// The parameters of a tile's dispatches, each of a bounded number of rays.
pub fn rays_of_dispatch(
    prepared: &Prepared,
    tile: Tile,
    params: DirectParams,
    rays: u32,
) -> impl Iterator<Item = DirectParams> {
    let most = rays_at_once(prepared.bvh.nodes.len());
    let slice = (dispatch_rays(prepared) / tile.points()).clamp(1, most);
    (0..rays).step_by(slice as usize).map(move |first| DirectParams {
        points: tile.points(),
        first,
        count: slice.min(rays - first),
        first_block: tile.first_block,
        sample: tile.sample,
        ..params
    })
}
