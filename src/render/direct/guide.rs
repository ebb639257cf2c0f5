//! The guide of light samples: which strata of the lights the points of each block of 8 × 8 pixels
//! see. Georgiev et al., "Importance Caching for Complex Illumination", Eurographics 2012.

use std::time::Duration;

use crate::gpu::{GpuError, GuideParams, TableFormat, Texture};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::lights::{LightKind, LightStrata};
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, NamedTexture, Stage};
use crate::sampling::{SURFACE_OFFSET, hash};

/// As in `shaders/direct/guide_params.wgsl`.
const STRATA_PER_ENTRY: usize = 8;

/// Pilot rays, and the probabilities of strata by what they found.
#[derive(Debug)]
pub struct Guide<'a> {
    prepared: &'a Prepared,
    /// What all tiles share.
    params: GuideParams,
    /// Of each block and stratum of the lights: its probability and all before it, and the share of
    /// its light that is thought to arrive.
    pub table: Texture,
    unshadowed: Stage,
    pilot: Stage,
    guide: Stage,
}

impl<'a> Guide<'a> {
    /// For the tiles of a frame and the strata of the lights of some kinds, with their table.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        kinds: &[LightKind],
        strata: &LightStrata,
        strata_table: &Texture,
        named: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, seed, tiling, .. } = *setup;
        let blocks = setup.most_points() / 64;
        let entries = blocks * strata.records.len();
        let table = prepared.gpu.table("guide", entries, TableFormat::Pairs)?;
        let texels = blocks * strata.records.len().div_ceil(STRATA_PER_ENTRY);
        let pilots = prepared.gpu.table("pilot rays", texels, TableFormat::Quadruples)?;
        let unshadowed_light = prepared.gpu.storage::<f32>("unshadowed light", entries)?;
        let named = [&[("unshadowed", &unshadowed_light)], named].concat();
        let bind = |program, textures: &[NamedTexture<'_>]| {
            let textures = [&[("light_strata", strata_table)], textures].concat();
            Stage::with_textures(prepared, program, &named, &textures)
        };
        let [unshadowed, pilot, guide] = prepared.direct_guide_programs(kinds);
        Ok(Self {
            unshadowed: bind(&unshadowed, &[])?,
            pilot: bind(&pilot, &[("guide", &table), ("counted_pilots", &pilots)])?,
            guide: bind(&guide, &[("pilots", &pilots), ("made_guide", &table)])?,
            params: GuideParams {
                across: tiling.across(),
                strata: strata.records.len() as u32,
                even_sky: strata.even_sky,
                seed: hash(seed ^ 0x1b87_3593),
                offset: SURFACE_OFFSET,
                nodes: prepared.bvh.nodes.len() as u32,
                ..bytemuck::Zeroable::zeroed()
            },
            prepared,
            table,
        })
    }

    /// Makes the guide of a tile from its visible points: first without any pilot ray, then by those
    /// that are drawn by it.
    ///
    /// # Errors
    /// The device fails.
    pub fn make(&self, tile: Tile) -> Result<Duration, GpuError> {
        let params =
            GuideParams { blocks: tile.blocks, first_block: tile.first_block, ..self.params };
        let run = |stage: &Stage, params| stage.run(self.prepared, &params, [tile.blocks, 1]);
        let before = run(&self.unshadowed, params)? + run(&self.guide, params)?;
        let pilots = run(&self.pilot, params)?;
        Ok(before + pilots + run(&self.guide, GuideParams { is_piloted: 1, ..params })?)
    }
}
