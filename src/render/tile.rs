//! The passes of a frame, tile by tile: a tile is a run of 8 × 8 pixel blocks, small enough
//! that no buffer meets an adapter's limits and no dispatch takes many seconds.

use std::cell::Cell;
use std::time::{Duration, Instant};

use super::film::{BLOCK, TILE_BLOCKS, develop, image_blocks};
use super::stages::{Indirect, MATRIX_WORDS, Stage, Stages};
use super::{Counts, Method, Phases, Prepared, Progress, Settings, kernels};
use crate::gpu::{CameraParams, DirectParams, GpuError, ShadeParams, VisibilityParams};
use crate::image::Image;
use crate::sampling::{SURFACE_OFFSET, hash};
use crate::scene::Camera;

/// Shadow rays of a dispatch, at most, where they are fast and where they are slow.
const DISPATCH_RAYS: u32 = 1 << 23;
const DISPATCH_RAYS_LARGE: u32 = 1 << 21;
/// Scenes of more BVH nodes are slow.
const LARGE_SCENE_NODES: usize = 4096;

/// Renders the tiles of one frame.
#[derive(Debug)]
pub struct TileRenderer<'a> {
    prepared: &'a Prepared,
    camera: &'a Camera,
    settings: &'a Settings,
    seed: u32,
    indirect: Option<Indirect>,
    stages: Stages,
    /// Shadow rays that an invocation traces in a dispatch; halved where a driver cuts their
    /// loops short.
    rays_at_once: Cell<u32>,
}

/// A run of blocks, and the sample of its pixels that is being taken.
#[derive(Debug, Clone, Copy)]
struct Tile {
    first_block: u32,
    blocks: u32,
    sample: u32,
}

impl Tile {
    fn points(&self) -> u32 {
        self.blocks * BLOCK
    }
}

impl<'a> TileRenderer<'a> {
    /// Binds what the frame needs.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &'a Prepared,
        camera: &'a Camera,
        settings: &'a Settings,
        seed: u32,
        indirect: Option<Indirect>,
    ) -> Result<Self, GpuError> {
        let stages = Stages::new(prepared, camera, settings, indirect.as_ref())?;
        let rays_at_once = Cell::new(32);
        Ok(Self { prepared, camera, settings, seed, indirect, stages, rays_at_once })
    }

    /// Renders all tiles.
    ///
    /// # Errors
    /// The device fails.
    pub fn render(
        &self,
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<Image, GpuError> {
        let mut image = blank(self.camera.size)?;
        let unit = match self.settings.method {
            Method::Depth => self.prepared.scene.units.scale as f32,
            _ => 1.0,
        };
        let weight = unit / self.settings.samples as f32;
        let (mut reflected, mut removed) = (0.0, 0.0);
        let all = image_blocks(self.camera);
        for first_block in (0..all).step_by(TILE_BLOCKS as usize) {
            let blocks = TILE_BLOCKS.min(all - first_block);
            self.prepared.gpu.clear(&[&self.stages.film])?;
            self.prepared.gpu.clear(&self.stages.energy.iter().collect::<Vec<_>>())?;
            for sample in 0..self.settings.samples {
                let tile = Tile { first_block, blocks, sample };
                let done = f64::from(first_block) + f64::from(blocks * sample) / self.samples();
                self.sample(tile, phases, counts, &|share, phase| {
                    let share = share * f64::from(blocks) / self.samples();
                    progress((done + share) / f64::from(all), phase);
                })?;
            }
            let start = Instant::now();
            let points = (blocks * BLOCK) as usize;
            let film: Vec<[f32; 4]> = self.prepared.gpu.read(&self.stages.film, points)?;
            counts.visible_points += develop(first_block, &film, weight, &mut image);
            if let Some(energy) = &self.stages.energy {
                for [kept, lost] in self.prepared.gpu.read::<[f32; 2]>(energy, points)? {
                    reflected += f64::from(kept);
                    removed += f64::from(lost);
                }
            }
            phases.readback += start.elapsed();
        }
        if removed > 0.0 {
            counts.clamped_fraction = removed / (reflected + removed);
        }
        let finite = |pixel: &&[f32; 3]| !pixel.iter().all(|channel| channel.is_finite());
        counts.nonfinite_pixels = image.pixels.iter().filter(finite).count() as u64;
        Ok(image)
    }

    /// One sample of every pixel of a tile: camera rays, direct light, indirect light.
    fn sample(
        &self,
        tile: Tile,
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        progress(0.0, "visible points");
        let groups = [tile.blocks, 1];
        phases.visible_points +=
            self.run(&self.stages.visible, &self.camera_params(tile), groups)?;
        for stage in self.stages.show.iter().chain(&self.stages.emit) {
            phases.shading += self.run(stage, &(), groups)?;
        }
        if self.stages.direct_point.is_some() || self.stages.direct_area.is_some() {
            progress(0.0, "direct light");
            self.clear_irradiance()?;
            phases.direct += self.direct(tile)?;
            phases.direct += self.reflect(groups)?;
        }
        if let Some(indirect) = &self.indirect {
            self.clear_irradiance()?;
            self.gather(tile, indirect, phases, counts, progress)?;
            phases.shading += self.reflect(groups)?;
            if let Some(stage) = &self.stages.removed {
                phases.shading += self.run(stage, &(), groups)?;
            }
        }
        Ok(())
    }

    /// Direct light, in dispatches of a bounded number of shadow rays.
    fn direct(&self, tile: Tile) -> Result<Duration, GpuError> {
        let most = kernels::rays_at_once(self.prepared.bvh.nodes.len());
        let slice = (self.dispatch_rays() / tile.points()).clamp(1, most);
        let samples = self.settings.light_samples_per_point();
        let mut time = Duration::ZERO;
        let lights = &self.prepared.lights;
        let kinds = [
            (&self.stages.direct_point, lights.point.len() as u32, lights.point.len() as u32),
            (&self.stages.direct_area, lights.area.len() as u32, samples),
        ];
        for (stage, lights, rays) in kinds {
            if let Some(stage) = stage {
                for start in (0..rays).step_by(slice as usize) {
                    let params = DirectParams {
                        points: tile.points(),
                        lights,
                        first: start,
                        count: slice.min(rays - start),
                        seed: hash(self.seed),
                        first_block: tile.first_block,
                        offset: SURFACE_OFFSET,
                        nodes: self.prepared.bvh.nodes.len() as u32,
                        sample: tile.sample,
                        samples: self.settings.samples,
                        weight: 1.0 / (rays as f32 * self.settings.samples as f32),
                        share: 1.0 / rays as f32,
                    };
                    time += self.run(stage, &params, [tile.blocks, 1])?;
                }
            }
        }
        Ok(time)
    }

    /// Indirect light: for as many VPLs as the bit matrix holds, who sees whom, then shading.
    fn gather(
        &self,
        tile: Tile,
        indirect: &Indirect,
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<(), GpuError> {
        let (Some(visibility), Some(shade)) = (&self.stages.visibility, &self.stages.shade) else {
            return Ok(());
        };
        let rows = tile.points();
        let words = indirect.count.div_ceil(32);
        let groups = self.point_groups(rows);
        let slice = (self.dispatch_rays() / (32 * rows)).max(1);
        for matrix_word in (0..words).step_by(MATRIX_WORDS as usize) {
            let matrix_words = MATRIX_WORDS.min(words - matrix_word);
            let start = Instant::now();
            for offset in (0..matrix_words).step_by(slice as usize) {
                let first_word = matrix_word + offset;
                progress(f64::from(first_word) / f64::from(words), "visibility");
                let params = VisibilityParams {
                    rows,
                    vpls: indirect.count,
                    first_word,
                    matrix_word,
                    offset: SURFACE_OFFSET,
                    nodes: self.prepared.bvh.nodes.len() as u32,
                    first: 0,
                    count: 32,
                };
                let across = [groups, slice.min(matrix_words - offset)];
                counts.shadow_rays += self.trace(visibility, params, across)?;
            }
            phases.visibility += start.elapsed();
            let params = ShadeParams {
                points: rows,
                rows,
                matrix_word,
                words: matrix_words,
                bound: indirect.bound.unwrap_or(0.0),
                pad: [0; 3],
            };
            phases.shading += self.run(shade, &params, [groups, 1])?;
        }
        counts.shading_terms += u64::from(rows) * u64::from(indirect.count);
        Ok(())
    }

    /// Traces the shadow rays of some words, in as many dispatches as it takes for every loop
    /// to come to its end: some drivers bound the rounds of an invocation's loops. Returns how
    /// many rays there were.
    fn trace(
        &self,
        visibility: &Stage,
        params: VisibilityParams,
        groups: [u32; 2],
    ) -> Result<u64, GpuError> {
        let gpu = &self.prepared.gpu;
        loop {
            let count = self.rays_at_once.get();
            gpu.clear(&[&self.stages.counter])?;
            for first in (0..32).step_by(count as usize) {
                self.run(visibility, &VisibilityParams { first, count, ..params }, groups)?;
            }
            let counter: Vec<u32> = gpu.read(&self.stages.counter, 3)?;
            match counter[..] {
                [low, high, 0] => return Ok(u64::from(high) << 32 | u64::from(low)),
                _ if count > 1 => self.rays_at_once.set(count / 2),
                _ => return Err(GpuError::LoopCut),
            }
        }
    }

    fn reflect(&self, groups: [u32; 2]) -> Result<Duration, GpuError> {
        self.stages
            .reflect
            .as_ref()
            .map_or(Ok(Duration::ZERO), |stage| self.run(stage, &(), groups))
    }

    fn clear_irradiance(&self) -> Result<(), GpuError> {
        self.prepared.gpu.clear(&self.stages.irradiance.iter().collect::<Vec<_>>())
    }

    fn run<P: bytemuck::Pod>(
        &self,
        stage: &Stage,
        params: &P,
        workgroups: [u32; 2],
    ) -> Result<Duration, GpuError> {
        stage.run(self.prepared, params, workgroups)
    }

    fn camera_params(&self, tile: Tile) -> CameraParams {
        let camera = self.camera;
        let [x, y] = camera.half_tangents();
        CameraParams {
            position: camera.position.to_array(),
            width: camera.size[0],
            forward: camera.forward.to_array(),
            height: camera.size[1],
            right: (camera.right * x).to_array(),
            first_block: tile.first_block,
            up: (camera.up * y).to_array(),
            sample: tile.sample,
            samples: self.settings.samples,
            seed: hash(self.seed ^ 0x68e3_1da4),
            blocks: tile.blocks,
            nodes: self.prepared.bvh.nodes.len() as u32,
        }
    }

    /// Workgroups for so many points: with subgroups a lane has four.
    fn point_groups(&self, points: u32) -> u32 {
        match self.prepared.gpu.has_subgroups() {
            true => points.div_ceil(4 * 64),
            false => points.div_ceil(64),
        }
    }

    fn dispatch_rays(&self) -> u32 {
        let large = self.prepared.bvh.nodes.len() > LARGE_SCENE_NODES;
        if large { DISPATCH_RAYS_LARGE } else { DISPATCH_RAYS }
    }

    fn samples(&self) -> f64 {
        f64::from(self.settings.samples)
    }
}

/// A black image, if there is memory for one.
fn blank([width, height]: [u32; 2]) -> Result<Image, GpuError> {
    let count = width as usize * height as usize;
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(count).map_err(|_| GpuError::ImageTooLarge {
        width,
        height,
        bytes: (count * size_of::<[f32; 3]>()) as u64,
    })?;
    pixels.resize(count, [0.0; 3]);
    Ok(Image { width, height, pixels })
}
