//! The filter of direct light: light samples are combined over pixels that see the same surface, as far
//! as their noise hides a difference. An à-trous filter (Dammertz et al., "Edge-Avoiding À-Trous
//! Wavelet Transform for fast Global Illumination Filtering", HPG 2010) under control of its own
//! variance (Schied et al., "Spatiotemporal Variance-Guided Filtering", HPG 2017), which the halves of
//! the samples of a pixel tell.

use std::time::Duration;

use crate::gpu::{FilterParams, GpuError};
use crate::render::camera::{FrameSetup, Tile};
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};

/// Levels: taps of 3 × 3 pixels, each twice as far apart as those before.
const LEVELS: u32 = 4;
/// The squared difference of local means over their variance that counts 1/e, for one sample a pixel.
const TOLERANCE: f32 = 2.25;

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
    means: Stage,
    /// From either buffer to the other; from the second to the irradiance of points.
    levels: [Stage; 2],
    last: Stage,
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
        let surfaces = gpu.storage::<[u32; 4]>("surfaces", points)?;
        let local_means = gpu.storage::<[f32; 2]>("local means", points)?;
        let ray_counts = gpu.storage::<u32>("ray counts", points)?;
        let first = gpu.storage::<[f32; 4]>("light to combine", values)?;
        let second = gpu.storage::<[f32; 4]>("combined light", values)?;
        let own = [
            ("surfaces", &surfaces),
            ("local_means", &local_means),
            ("ray_counts", &ray_counts),
            irradiance,
        ];
        let named = [&own[..], named].concat();
        let [pack, counts, means, level] = prepared.direct_filter_programs();
        let bind = |program, from: &wgpu::Buffer, to: &wgpu::Buffer| {
            let named = [&[("gathered", from), ("combined", to)], &named[..]].concat();
            Stage::new(prepared, program, &named)
        };
        Ok(Self {
            surfaces: bind(&pack, &first, &second)?,
            counts: bind(&counts, &first, &second)?,
            means: bind(&means, &first, &second)?,
            levels: [bind(&level, &first, &second)?, bind(&level, &second, &first)?],
            last: bind(&level, &second, irradiance.1)?,
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
        let mut time = self.run(&self.means, params, tile)?;
        for level in 0..LEVELS {
            let last = level + 1 == LEVELS;
            let stage = if last { &self.last } else { &self.levels[level as usize % 2] };
            let params = FilterParams { step: 1 << level, last: u32::from(last), ..params };
            time += self.run(stage, params, tile)?;
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

// The last level reads the second buffer.
const _: () = assert!(LEVELS.is_multiple_of(2));
