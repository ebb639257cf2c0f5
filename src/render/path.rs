//! The path tracer: the reference for all that VPLs approximate. It shares scene, hierarchy,
//! camera and random numbers with them, but no light transport.
//!
//! A wave of paths, some samples of every pixel of a tile, goes from vertex to vertex together:
//! shadow rays to the lights from each vertex, then the next segment of each path. A stage traces
//! one ray a path, and between stages the paths that have ended leave the queue.

mod estimate;
pub mod stages;
pub mod vertices;

use std::time::{Duration, Instant};

use super::camera::{BLOCK, blank, camera_params};
use super::prepared::Prepared;
use super::result::{Counts, Frame, Phases, Progress};
use super::settings::{Bounces, Direct, Settings};
use super::visibility::dispatch_rays;
use crate::gpu::{CameraParams, GpuError, PathParams, PathSum};
use crate::sampling::SURFACE_OFFSET;
use crate::scene::Camera;
use estimate::Estimates;
use stages::Stages;

/// Paths of a wave, at most: few enough for any adapter's buffers, many enough that the stages
/// themselves cost nothing.
const MOST_PATHS: u32 = 1 << 20;
/// Samples of a pixel in a wave, at most: the device sums them in f32.
const MOST_SAMPLES: u32 = 64;
/// Samples of a pixel in a wave where there are enough: their rays are near each other.
const GOOD_SAMPLES: u32 = 16;

/// Some samples of every pixel of a run of 8 × 8 blocks.
#[derive(Debug, Clone, Copy)]
struct Wave {
    first_block: u32,
    blocks: u32,
    first_sample: u32,
    samples: u32,
}

impl Wave {
    fn pixels(&self) -> u32 {
        self.blocks * BLOCK
    }

    fn paths(&self) -> u32 {
        self.pixels() * self.samples
    }
}

/// Renders the paths of one frame.
#[derive(Debug)]
pub struct PathTracer<'a> {
    prepared: &'a Prepared,
    camera: &'a Camera,
    settings: &'a Settings,
    seed: u32,
    /// Samples of a pixel in a wave, and blocks.
    wave: [u32; 2],
    stages: Stages,
}

impl<'a> PathTracer<'a> {
    /// Binds what the frame needs.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &'a Prepared,
        camera: &'a Camera,
        settings: &'a Settings,
        seed: u32,
    ) -> Result<Self, GpuError> {
        let wave = wave_size(dispatch_rays(prepared), all_blocks(camera), settings.samples);
        Self::in_waves(prepared, camera, settings, seed, wave)
    }

    fn in_waves(
        prepared: &'a Prepared,
        camera: &'a Camera,
        settings: &'a Settings,
        seed: u32,
        wave: [u32; 2],
    ) -> Result<Self, GpuError> {
        let [samples, blocks] = wave;
        let pixels = (blocks * BLOCK) as usize;
        let stages = Stages::new(prepared, settings, pixels * samples as usize, pixels)?;
        Ok(Self { prepared, camera, settings, seed, wave, stages })
    }

    /// Renders the frame, tile by tile and wave by wave.
    ///
    /// # Errors
    /// The device fails.
    pub fn render(&self, progress: Progress<'_>) -> Result<Frame, GpuError> {
        let (mut phases, mut counts) = (Phases::default(), Counts::default());
        let mut image = blank(self.camera.size)?;
        let two = self.settings.samples >= 2;
        let mut standard_error = two.then(|| blank(self.camera.size)).transpose()?;
        let ([samples, blocks], all) = (self.wave, all_blocks(self.camera));
        let per_tile = self.settings.samples.div_ceil(samples);
        let waves = f64::from(all.div_ceil(blocks)) * f64::from(per_tile);
        let mut done = 0.0;
        for first_block in (0..all).step_by(blocks as usize) {
            let blocks = blocks.min(all - first_block);
            let mut estimates = Estimates::new((blocks * BLOCK) as usize);
            for first_sample in (0..self.settings.samples).step_by(samples as usize) {
                let samples = samples.min(self.settings.samples - first_sample);
                let wave = Wave { first_block, blocks, first_sample, samples };
                progress(done / waves, "paths");
                let sums = self.trace(&wave, &mut phases, &mut counts)?;
                counts.shadow_rays += estimates.add(&sums, samples);
                done += 1.0;
            }
            let tile = first_block..first_block + blocks;
            estimates.develop(&tile, &mut image, standard_error.as_mut());
        }
        let finite = |pixel: &&[f32; 3]| !pixel.iter().all(|channel| channel.is_finite());
        counts.nonfinite_pixels = image.pixels.iter().filter(finite).count() as u64;
        let dispatches = self.prepared.gpu.take_dispatch_times()?;
        Ok(Frame { image, standard_error, counts, phases, dispatches })
    }

    /// The paths of a wave from the camera to their ends.
    fn trace(
        &self,
        wave: &Wave,
        phases: &mut Phases,
        counts: &mut Counts,
    ) -> Result<Vec<PathSum>, GpuError> {
        let stages = &self.stages;
        let params = PathParams {
            paths: wave.paths(),
            first_sample: wave.first_sample,
            samples: wave.samples,
            ..path_params(self.prepared)
        };
        let groups = [wave.paths().div_ceil(64), 1];
        phases.visible_points +=
            stages.camera.run(self.prepared, &self.camera_params(wave), groups)?;
        for emit in &stages.emit {
            phases.shading += emit.run(self.prepared, &(), groups)?;
        }
        let mut params = PathParams { paths: self.survivors(&params, phases)?, ..params };
        counts.visible_points += u64::from(params.paths);
        while params.paths > 0 {
            // The light of a vertex: from shadow rays, and from what the next segment happens upon.
            let is_lit = params.bounce > 0 || self.settings.direct != Direct::Off;
            if is_lit {
                params = finding_light(self.prepared, params);
                let time = self.shadow_rays(&params)?;
                let first = params.bounce == 0;
                *(if first { &mut phases.direct } else { &mut phases.visibility }) += time;
            }
            let last = self.settings.bounces == Bounces::Finite(params.bounce);
            let goes_on = !last || finds_light(&params);
            let Some(segment) = stages.segment.as_ref().filter(|_| goes_on) else { break };
            let groups = [params.paths.div_ceil(64), 1];
            phases.visibility += segment.run(self.prepared, &params, groups)?;
            if last {
                break;
            }
            params.paths = self.survivors(&params, phases)?;
            params.bounce += 1;
        }
        self.sums(wave, &params, phases)
    }

    /// Light straight from its source at the vertices of the queue.
    fn shadow_rays(&self, params: &PathParams) -> Result<Duration, GpuError> {
        let groups = [params.paths.div_ceil(64), 1];
        let mut time = Duration::ZERO;
        for (stage, lights) in &self.stages.lights {
            let params = PathParams { lights: *lights, ..*params };
            time += stage.run(self.prepared, &params, groups)?;
        }
        Ok(time)
    }

    /// Makes the queue of the paths that go on, of those that `params` counts; how many they are.
    fn survivors(&self, params: &PathParams, phases: &mut Phases) -> Result<u32, GpuError> {
        let start = Instant::now();
        let all = self.stages.queue.survivors(self.prepared, params)?;
        phases.shading += start.elapsed();
        Ok(all)
    }

    /// What the samples of each pixel came to.
    fn sums(
        &self,
        wave: &Wave,
        params: &PathParams,
        phases: &mut Phases,
    ) -> Result<Vec<PathSum>, GpuError> {
        let stages = &self.stages;
        let params = PathParams { paths: wave.pixels(), ..*params };
        phases.shading += stages.sum.run(self.prepared, &params, [wave.blocks, 1])?;
        let start = Instant::now();
        let sums = self.prepared.gpu.read(&stages.sums, wave.pixels() as usize)?;
        phases.readback += start.elapsed();
        Ok(sums)
    }

    fn camera_params(&self, wave: &Wave) -> CameraParams {
        CameraParams {
            first_block: wave.first_block,
            sample: wave.first_sample,
            blocks: wave.blocks,
            rays: wave.samples,
            ..camera_params(self.prepared, self.camera, self.settings.samples, self.seed)
        }
    }
}

/// Parameters of paths of which nothing is known yet; they find no light.
pub fn path_params(prepared: &Prepared) -> PathParams {
    PathParams {
        nodes: prepared.bvh.nodes.len() as u32,
        offset: SURFACE_OFFSET,
        ..bytemuck::Zeroable::zeroed()
    }
}

/// Paths of which the next segment counts the light that it happens upon.
pub fn finding_light(prepared: &Prepared, params: PathParams) -> PathParams {
    PathParams {
        light_density: prepared.lights.area_density(),
        solid_density: prepared.lights.solid_density(),
        background: if prepared.features.sky.shines() { 1.0 } else { 0.0 },
        ..params
    }
}

/// Whether there is light that the next segment may happen upon, and that counts.
pub fn finds_light(params: &PathParams) -> bool {
    params.light_density.max(params.solid_density).max(params.background) > 0.0
}

fn all_blocks(camera: &Camera) -> u32 {
    let [across, down] = camera.size.map(|extent| extent.div_ceil(8));
    across * down
}

/// Samples of a pixel in a wave, and blocks of pixels, so that a wave of an image of `all_blocks`
/// blocks is large, but no larger than `rays`.
fn wave_size(rays: u32, all_blocks: u32, samples: u32) -> [u32; 2] {
    let blocks = MOST_PATHS.min(rays) / BLOCK;
    let samples = (blocks / all_blocks).clamp(GOOD_SAMPLES, MOST_SAMPLES).min(samples);
    [samples, (blocks / samples).clamp(1, all_blocks)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::{AdapterChoice, Gpu};
    use crate::image::Image;
    use crate::render::settings::Method;
    use crate::scene::Scene;

    #[test]
    fn the_size_of_waves_does_not_change_the_image() {
        let scene = Scene::load("builtin:cornell").unwrap();
        let camera = Camera { size: [40, 24], ..scene.camera };
        let settings =
            Settings { samples: 100, bounces: Bounces::Unlimited, ..Settings::of(Method::Path) };
        let gpu = Gpu::open(&AdapterChoice::Auto).unwrap();
        let prepared = Prepared::new(gpu, scene, &settings).unwrap();
        let [whole, parts] = [[64, 15], [9, 4]].map(|wave| {
            let tracer = PathTracer::in_waves(&prepared, &camera, &settings, 3, wave).unwrap();
            tracer.render(&|_, _| {}).unwrap()
        });
        assert_eq!(whole.counts, parts.counts);
        let alike = |one: &Image, other: &Image| {
            let mut pairs = one.pixels.iter().flatten().zip(other.pixels.iter().flatten());
            pairs.all(|(a, b)| (a - b).abs() <= 1e-5 * b)
        };
        assert!(alike(&whole.image, &parts.image));
        assert!(alike(&whole.standard_error.unwrap(), &parts.standard_error.unwrap()));
    }

    #[test]
    fn waves_are_large_but_not_too_large() {
        let rays = 1 << 26;
        // 512 × 512 pixels.
        assert_eq!(wave_size(rays, 4096, 1), [1, 4096]);
        assert_eq!(wave_size(rays, 4096, 4), [4, 4096]);
        assert_eq!(wave_size(rays, 4096, 4096), [16, 1024]);
        // One pixel, and 16,384².
        assert_eq!(wave_size(rays, 1, 4096), [64, 1]);
        assert_eq!(wave_size(rays, 1 << 22, 1), [1, 1 << 14]);
        assert_eq!(wave_size(64, 4096, 4096), [16, 1]);
    }
}
