//! The guide of light samples: which strata of the lights the points of each block of 8 × 8 pixels
//! see. Georgiev et al., "Importance Caching for Complex Illumination", Eurographics 2012.

use std::time::Duration;

use crate::gpu::{GpuError, GuideParams, Program};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::lights::LightStrata;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};
use crate::sampling::{SURFACE_OFFSET, hash};

/// Pilot rays, and the probabilities of strata by what they found.
#[derive(Debug)]
pub struct Guide<'a> {
    prepared: &'a Prepared,
    /// What all tiles share.
    params: GuideParams,
    /// Of each block and stratum of the lights: its probability and all before it.
    table: wgpu::Buffer,
    /// The share of its light that is thought to arrive.
    arriving: wgpu::Buffer,
    unshadowed: Stage,
    pilot: Stage,
    guide: Stage,
}

impl<'a> Guide<'a> {
    /// For the tiles of a frame and these strata, which are bound by name; by the programs of
    /// unshadowed light, of pilot rays and of the guide.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        strata: &LightStrata,
        [unshadowed, pilot, guide]: [&Program; 3],
        named: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, seed, tiling, .. } = *setup;
        let points = setup.most_points();
        let entries = points / 64 * strata.records.len();
        let table = prepared.gpu.storage::<f32>("guide", entries)?;
        let pilots = prepared.gpu.storage::<u32>("pilot rays", entries)?;
        let unshadowed_light = prepared.gpu.storage::<f32>("unshadowed light", entries)?;
        let arriving = prepared.gpu.storage::<f32>("arriving share", entries)?;
        let own = [
            ("guide", &table),
            ("pilots", &pilots),
            ("unshadowed", &unshadowed_light),
            ("arriving_share", &arriving),
        ];
        let named = [&own[..], named].concat();
        let params = GuideParams {
            across: tiling.across(),
            strata: strata.records.len() as u32,
            even_sky: strata.even_sky,
            seed: hash(seed ^ 0x1b87_3593),
            offset: SURFACE_OFFSET,
            nodes: prepared.bvh.nodes.len() as u32,
            ..bytemuck::Zeroable::zeroed()
        };
        Ok(Self {
            prepared,
            params,
            unshadowed: Stage::new(prepared, unshadowed, &named)?,
            pilot: Stage::new(prepared, pilot, &named)?,
            guide: Stage::new(prepared, guide, &named)?,
            table,
            arriving,
        })
    }

    /// What samples are drawn by, by name.
    pub fn named(&self) -> [Named<'_>; 2] {
        [("guide", &self.table), ("arriving_share", &self.arriving)]
    }

    /// Has samples drawn from all strata alike.
    ///
    /// # Errors
    /// The device fails.
    pub fn make_even(&self) -> Result<(), GpuError> {
        let strata = self.params.strata;
        let row: Vec<f32> = (1..=strata).map(|i| i as f32 / strata as f32).collect();
        let rows = self.table.size() as usize / size_of_val(&row[..]);
        self.prepared.gpu.write(&self.table, &row.repeat(rows))?;
        self.prepared.gpu.write(&self.arriving, &vec![1f32; rows * row.len()])
    }

    /// Makes the guide of a tile from its visible points: first without any pilot ray, then two
    /// rounds of them, each drawn by what is known before.
    ///
    /// # Errors
    /// The device fails.
    pub fn make(&self, tile: Tile) -> Result<Duration, GpuError> {
        let params =
            GuideParams { blocks: tile.blocks, first_block: tile.first_block, ..self.params };
        let run = |stage: &Stage, params| stage.run(self.prepared, &params, [tile.blocks, 1]);
        let mut time = run(&self.unshadowed, params)? + run(&self.guide, params)?;
        for round in 1..=2 {
            let params = GuideParams { round, ..params };
            time += run(&self.pilot, params)? + run(&self.guide, params)?;
        }
        Ok(time)
    }
}
