//! The filter of direct light: light samples are combined over pixels that see the same surface, as far
//! as their noise hides a difference. An à-trous filter (Dammertz et al., "Edge-Avoiding À-Trous
//! Wavelet Transform for fast Global Illumination Filtering", HPG 2010) under control of its own
//! variance (Schied et al., "Spatiotemporal Variance-Guided Filtering", HPG 2017), which the halves of
//! the samples of a pixel tell.

use std::time::Duration;

use crate::gpu::{FilterParams, GpuError, Program, TableFormat};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, NamedTexture, Stage};

/// Levels: taps of 3 × 3 pixels, each twice as far apart as those before.
const LEVELS: u32 = 4;
/// The squared difference of local means over their variance that counts 1/e, for one sample a pixel.
const TOLERANCE: f32 = 2.25;

/// Of those, whose taps are among the 5 × 5 pixels around.
const NEAR_LEVELS: u32 = 2;

/// The stages of the filter, and its buffers.
#[derive(Debug)]
pub struct DirectFilter<'a> {
    prepared: &'a Prepared,
    /// Blocks across the image.
    across: u32,
    params: FilterParams,
    /// How many light samples each point takes.
    pub ray_counts: wgpu::Buffer,
    surfaces: Stage,
    counts: Stage,
    light: Stage,
    means: Stage,
    /// The last one's result is the irradiance of points.
    levels: Vec<Stage>,
}

impl<'a> DirectFilter<'a> {
    /// For the irradiance among the named buffers of a tile, of points that take `rays` samples or,
    /// where few pixels are like them, more.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        rays: u32,
        irradiance: Named<'_>,
        named: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        let FrameSetup { prepared, settings, tiling, .. } = *setup;
        let (gpu, points) = (&prepared.gpu, setup.most_points());
        let values = points * prepared.target().lobes();
        let like_pixels = gpu.storage::<u32>("like pixels", points)?;
        let ray_counts = gpu.storage::<u32>("ray counts", points)?;
        let surfaces = gpu.table("surfaces", points, TableFormat::Quadruples)?;
        let means = gpu.table("means", points, TableFormat::Pairs)?;
        let local_means = gpu.table("local means", points, TableFormat::Pairs)?;
        let light = [
            gpu.table("light to combine", values, TableFormat::Quadruples)?,
            gpu.table("combined light", values, TableFormat::Quadruples)?,
        ];
        let own = [("like_pixels", &like_pixels), ("ray_counts", &ray_counts), irradiance];
        let named = [&own[..], named].concat();
        let bind = |program: &Program, textures: &[NamedTexture<'_>]| {
            Stage::with_textures(prepared, program, &named, textures)
        };
        let [pack, counts, pack_light, guide, near, far, last] = prepared.direct_filter_programs();
        let levels = (0..LEVELS).map(|level| {
            let program = match level {
                level if level + 1 == LEVELS => &last,
                level if level < NEAR_LEVELS => &near,
                _ => &far,
            };
            // From either table to the other.
            let [from, to] = [level % 2, (level + 1) % 2].map(|i| &light[i as usize]);
            let textures = [("light", from), ("stored_light", to), ("means", &local_means)];
            bind(program, &[&textures[..], &[("surface_table", &surfaces)]].concat())
        });
        Ok(Self {
            levels: levels.collect::<Result<_, _>>()?,
            surfaces: bind(&pack, &[("packed_surfaces", &surfaces)])?,
            counts: bind(&counts, &[("surface_table", &surfaces)])?,
            light: bind(&pack_light, &[("stored_light", &light[0]), ("packed_means", &means)])?,
            means: bind(&guide, &[("means", &means), ("packed_means", &local_means)])?,
            ray_counts,
            params: FilterParams {
                rays,
                // The mean of many samples of a pixel is less noisy than each of them.
                tolerance: TOLERANCE / settings.samples as f32,
                ..bytemuck::Zeroable::zeroed()
            },
            across: tiling.across(),
            prepared,
        })
    }

    /// Looks at the surfaces of a tile, and says how many light samples its points take.
    ///
    /// # Errors
    /// The device fails.
    pub fn count(&self, tile: Tile) -> Result<Duration, GpuError> {
        let params = self.params_of(tile);
        Ok(self.run(&self.surfaces, params, tile)? + self.run(&self.counts, params, tile)?)
    }

    /// Combines the irradiance of a tile.
    ///
    /// # Errors
    /// The device fails.
    pub fn combine(&self, tile: Tile) -> Result<Duration, GpuError> {
        let params = self.params_of(tile);
        let mut time =
            self.run(&self.light, params, tile)? + self.run(&self.means, params, tile)?;
        for (level, stage) in self.levels.iter().enumerate() {
            time += self.run(stage, FilterParams { step: 1 << level, ..params }, tile)?;
        }
        Ok(time)
    }

    fn run(&self, stage: &Stage, params: FilterParams, tile: Tile) -> Result<Duration, GpuError> {
        stage.run(self.prepared, &params, [tile.blocks, 1])
    }

    fn params_of(&self, tile: Tile) -> FilterParams {
        let [width, height] = [self.across, tile.blocks / self.across].map(|blocks| 8 * blocks);
        FilterParams { width, height, ..self.params }
    }
}
