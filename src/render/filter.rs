//! A filter of noisy light, straight from its source or what bias compensation gives back: samples are
//! combined over pixels that see the same surface, as far as their noise hides a difference. An à-trous filter (Dammertz et al., "Edge-Avoiding À-Trous
//! Wavelet Transform for fast Global Illumination Filtering", HPG 2010) under control of its own
//! variance (Schied et al., "Spatiotemporal Variance-Guided Filtering", HPG 2017), which the halves of
//! the samples of a pixel tell.

use std::time::Duration;

use crate::gpu::{FilterParams, GpuError, Program, TableFormat};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::kernels::Filtered;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, NamedTexture, Stage};

/// Levels: taps of 3 × 3 pixels, each twice as far apart as those before.
///
/// What bias compensation gives back is smoother than light straight from its source, and of heavier
/// noise. relMSE of an office behind a door that is ajar and of a classroom, by levels and tolerance: 4 and
/// 2.25 .0313, .0123; 5 and 2.25 .0275, .0119; 6 and 2.25 .0269, .0118; 4 and 5 .0287, .0118; 4 and 12
/// .0279, .0117; 5 and 5 .0260, .0116.
///
/// Fewer in images that are so small that things in them are.
fn levels(filtered: Filtered, blocks_across: u32) -> u32 {
    match filtered {
        Filtered::Direct => 4,
        Filtered::Compensation => (blocks_across.ilog2()).clamp(1, 5),
    }
}

/// The squared difference of local means over their variance that counts 1/e, for one sample a pixel.
fn tolerance(filtered: Filtered) -> f32 {
    match filtered {
        Filtered::Direct => 2.25,
        Filtered::Compensation => 5.0,
    }
}

/// The first levels, whose taps are among the 5 × 5 pixels around.
const NEAR_LEVELS: u32 = 2;

/// The stages of the filter, and its buffers.
#[derive(Debug)]
pub struct LightFilter<'a> {
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

impl<'a> LightFilter<'a> {
    /// For irradiance of points that take `rays` samples (for bias compensation, paths) or, where few
    /// pixels are like them, more; in its w, half the difference of the halves of their samples. The
    /// result takes its place. `tile` are the buffers of a tile.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        setup: &FrameSetup<'a>,
        filtered: Filtered,
        rays: u32,
        irradiance: &wgpu::Buffer,
        tile: &[Named<'_>],
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
        let own = [
            ("like_pixels", &like_pixels),
            ("ray_counts", &ray_counts),
            ("irradiance", irradiance),
        ];
        let named = [&own[..], tile].concat();
        let bind = |program: &Program, textures: &[NamedTexture<'_>]| {
            Stage::with_textures(prepared, program, &named, textures)
        };
        let programs = prepared.filter_programs(filtered);
        let count = levels(filtered, tiling.across());
        let levels = (0..count).map(|level| {
            let program = match level {
                level if level + 1 == count => &programs.last,
                level if level < NEAR_LEVELS => &programs.near,
                _ => &programs.far,
            };
            // From either table to the other.
            let [read, written] = [level % 2, (level + 1) % 2].map(|i| &light[i as usize]);
            let textures = [("light", read), ("stored_light", written), ("means", &local_means)];
            let textures = [&textures[..], &[("surface_table", &surfaces)]].concat();
            bind(program, &textures)
        });
        Ok(Self {
            levels: levels.collect::<Result<_, _>>()?,
            surfaces: bind(&programs.surfaces, &[("packed_surfaces", &surfaces)])?,
            counts: bind(&programs.counts, &[("surface_table", &surfaces)])?,
            light: bind(&programs.light, &[("stored_light", &light[0]), ("packed_means", &means)])?,
            means: bind(&programs.means, &[("means", &means), ("packed_means", &local_means)])?,
            ray_counts,
            params: FilterParams {
                rays,
                // The mean of many samples of a pixel is less noisy than each of them.
                tolerance: tolerance(filtered) / settings.samples as f32,
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
