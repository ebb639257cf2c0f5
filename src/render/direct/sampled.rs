//! Lights of some extent, and those without if they are many: a few rays to places that the guide
//! chooses.

use std::time::Duration;

use super::dispatches::rays_of_dispatch;
use super::guide::Guide;
use super::lobes::LobeRays;
use crate::gpu::{DirectParams, GpuError};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::filter::LightFilter;
use crate::render::kernels::Filtered;
use crate::render::lights::LightKind;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};
use crate::sampling::{SURFACE_OFFSET, hash};

/// As `MOST` of `shaders/direct/ray_counts.wgsl`.
const MOST_TIMES: u32 = 4;

/// Shadow rays to all lights that samples are drawn of.
#[derive(Debug)]
pub struct SampledLight<'a> {
    prepared: &'a Prepared,
    /// What all tiles share.
    params: DirectParams,
    guide: Option<Guide<'a>>,
    filter: Option<LightFilter<'a>>,
    stage: Stage,
    /// Rays by the lobes of glossy surfaces.
    lobes: Option<LobeRays<'a>>,
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
        let is_guided = settings.few_light_samples();
        let strata = prepared.lights.strata(kinds, is_guided);
        let table = prepared.gpu.texture_of("light_strata", &strata.records)?;
        let delta =
            prepared.gpu.storage_of("lights without extent", &prepared.lights.delta(kinds))?;
        let named = &[&[("delta_lights", &delta)], named].concat()[..];
        let guide =
            is_guided.then(|| Guide::new(setup, kinds, &strata, &table, named)).transpose()?;
        let rays = settings.light_samples_per_point();
        let filter = settings.filters_direct();
        let filter = filter
            .then(|| LightFilter::new(setup, Filtered::Direct, rays, irradiance.1, named))
            .transpose()?;
        let mut named = named.to_vec();
        named.extend(filter.iter().map(|filter| ("ray_counts", &filter.ray_counts)));
        let [area_density, solid_density, sky_density] = prepared.lights.densities(kinds);
        let params = DirectParams {
            area_density,
            solid_density,
            sky_density,
            lights: strata.records.len() as u32,
            rays,
            // Where pixels have few like neighbours, they take more.
            most_rays: if settings.counts_light_samples() { MOST_TIMES * rays } else { rays },
            candidates: candidates(prepared, kinds, is_guided),
            // The difference of two halves is what the filter takes the noise for.
            halves: if filter.is_some() { 2 } else { 1 },
            samples: settings.samples,
            seed: hash(seed),
            offset: SURFACE_OFFSET,
            nodes: prepared.bvh.nodes.len() as u32,
            ..bytemuck::Zeroable::zeroed()
        };
        let samples = prepared.direct_sampled_program(kinds, settings);
        let mut textures = vec![("light_strata", &table)];
        textures.extend(guide.iter().map(|guide| ("guide", &guide.table)));
        Ok(Self {
            stage: Stage::with_textures(prepared, &samples, &named, &textures)?,
            lobes: LobeRays::new(setup, kinds, &named)?,
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
        if let (Some(guide), 0) = (&self.guide, tile.sample) {
            time += guide.make(tile)?;
        }
        if let Some(filter) = &self.filter {
            time += filter.count(tile)?;
        }
        for params in rays_of_dispatch(self.prepared, tile, self.params) {
            time += self.stage.run(self.prepared, &params, [tile.blocks, 1])?;
        }
        if let Some(lobes) = &self.lobes {
            time += lobes.gather_wide(tile, self.params)?;
        }
        if let Some(filter) = &self.filter {
            time += filter.combine(tile)?;
        }
        if let Some(lobes) = &self.lobes {
            time += lobes.gather_narrow(tile, self.params)?;
        }
        Ok(time)
    }
}

/// Of how many places on the lights each ray chooses one. Among many lamps the pixels of a block are
/// near to different ones, which a guide hardly tells apart, and power not at all.
fn candidates(prepared: &Prepared, kinds: &[LightKind], is_guided: bool) -> u32 {
    const FEW_LIGHTS: u32 = 16;
    let lamps = kinds.iter().filter(|&&kind| kind != LightKind::Environment);
    match lamps.map(|&kind| prepared.lights.count(kind)).sum::<u32>() {
        FEW_LIGHTS.. if is_guided => 4,
        FEW_LIGHTS.. => 8,
        _ if is_guided => 2,
        _ => 1,
    }
}
