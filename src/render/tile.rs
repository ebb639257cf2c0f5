//! The passes of a frame, tile by tile: a tile is a run of 8 × 8 pixel blocks, small enough
//! that no buffer meets an adapter's limits and no dispatch takes many seconds.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::{Counts, Direct, Method, Phases, Prepared, Progress, Settings, kernels};
use crate::gpu::{
    Bindings, CameraParams, DirectParams, GpuError, Kernel, Pass, PointRecord, Program,
    ShadeParams, VisibilityParams,
};
use crate::image::Image;
use crate::sampling::{SURFACE_OFFSET, hash};
use crate::scene::Camera;

/// Pixels of a block.
const BLOCK: u32 = 64;
/// Blocks of a tile: 65,536 points.
const TILE_BLOCKS: u32 = 1024;
/// Words of 32 VPLs that the bit matrix holds at a time: 8 MiB a tile. Also fixes the order
/// of the sums, so it is no matter of tuning.
const MATRIX_WORDS: u32 = 32;
/// Shadow rays of a dispatch, at most, where they are fast and where they are slow.
const DISPATCH_RAYS: u32 = 1 << 23;
const DISPATCH_RAYS_LARGE: u32 = 1 << 21;
/// Scenes of more BVH nodes are slow.
const LARGE_SCENE_NODES: usize = 4096;

/// The VPLs of a frame on the device.
#[derive(Debug)]
pub struct Indirect {
    /// How many there are.
    pub count: u32,
    /// Filled up to whole words.
    pub buffer: wgpu::Buffer,
    /// The bound on G, in normalised units.
    pub bound: Option<f32>,
}

/// A kernel with its buffers bound and its parameters' buffer.
#[derive(Debug)]
struct Stage {
    kernel: Arc<Kernel>,
    bindings: Bindings,
    params: wgpu::Buffer,
}

/// Renders the tiles of one frame.
#[derive(Debug)]
pub struct TileRenderer<'a> {
    prepared: &'a Prepared,
    camera: &'a Camera,
    settings: &'a Settings,
    seed: u32,
    indirect: Option<Indirect>,
    tile_blocks: u32,
    film: wgpu::Buffer,
    energy: Option<wgpu::Buffer>,
    /// Irradiance of the kind of light being gathered.
    irradiance: Option<wgpu::Buffer>,
    counter: wgpu::Buffer,
    visible: Stage,
    show: Option<Stage>,
    emit: Option<Stage>,
    direct_point: Option<Stage>,
    direct_area: Option<Stage>,
    visibility: Option<Stage>,
    shade: Option<Stage>,
    reflect: Option<Stage>,
    removed: Option<Stage>,
}

impl<'a> TileRenderer<'a> {
    /// Allocates the buffers of a tile and binds the kernels that the frame needs.
    pub fn new(
        prepared: &'a Prepared,
        camera: &'a Camera,
        settings: &'a Settings,
        seed: u32,
        indirect: Option<Indirect>,
    ) -> Result<Self, GpuError> {
        let gpu = &prepared.gpu;
        let tile_blocks = image_blocks(camera).min(TILE_BLOCKS);
        let points = (tile_blocks * BLOCK) as usize;
        let lit = settings.method.is_lit();
        let direct = lit && settings.direct == Direct::PerPixel;
        let gathers = direct || indirect.is_some();
        let clamps = indirect.as_ref().is_some_and(|indirect| indirect.bound.is_some());

        let words = indirect.as_ref().map_or(0, |i| i.count.div_ceil(32).min(MATRIX_WORDS));
        let film = gpu.storage::<[f32; 4]>("film", points)?;
        let energy = clamps.then(|| gpu.storage::<[f32; 2]>("energy", points)).transpose()?;
        let irradiance =
            gathers.then(|| gpu.storage::<[f32; 4]>("irradiance", points)).transpose()?;
        let counter = gpu.storage::<u32>("ray counter", 2)?;
        let records = gpu.storage::<PointRecord>("visible points", points)?;
        let bits = indirect
            .is_some()
            .then(|| gpu.storage::<u32>("visibility bits", points * words as usize))
            .transpose()?;

        let mut buffers = vec![
            ("nodes", &prepared.nodes),
            ("triangles", &prepared.triangles),
            ("materials", &prepared.materials),
            ("points", &records),
            ("film", &film),
            ("counter", &counter),
        ];
        buffers.extend(bits.as_ref().map(|bits| ("bits", bits)));
        buffers.extend(irradiance.as_ref().map(|irradiance| ("irradiance", irradiance)));
        buffers.extend(indirect.as_ref().map(|indirect| ("vpls", &indirect.buffer)));
        buffers.extend(energy.as_ref().map(|energy| ("energy", energy)));
        let stage = |is: bool, program: Program, more: Option<&wgpu::Buffer>| {
            is.then(|| {
                let kernel = prepared.kernels.get(gpu, &program)?;
                // The largest of the parameter records; a kernel reads its own.
                let params = gpu.uniform::<CameraParams>("parameters")?;
                let mut buffers = buffers.clone();
                buffers.push(("params", &params));
                buffers.extend(more.map(|lights| ("lights", lights)));
                let bindings = gpu.bind(&kernel, &buffers)?;
                Ok(Stage { kernel, bindings, params })
            })
            .transpose()
        };
        let (point_lights, area_lights) = (&prepared.point_lights, &prepared.area_lights);
        let subgroups = gpu.has_subgroups();
        let bounced = indirect.is_some();
        let show = kernels::show(settings.method);
        Ok(Self {
            visible: stage(true, kernels::visible_points(subgroups), None)?
                .ok_or_else(|| GpuError::Invalid("no camera pass".to_owned()))?,
            show: show.map(|program| stage(true, program, None)).transpose()?.flatten(),
            emit: stage(lit && area_lights.is_some(), kernels::emit(), None)?,
            direct_point: stage(
                direct && point_lights.is_some(),
                kernels::direct_point(subgroups),
                point_lights.as_ref(),
            )?,
            direct_area: stage(
                direct && area_lights.is_some(),
                kernels::direct_area(subgroups),
                area_lights.as_ref(),
            )?,
            visibility: stage(bounced, kernels::visibility_for(prepared), None)?,
            shade: stage(bounced, kernels::shade(subgroups, clamps), None)?,
            reflect: stage(gathers, kernels::reflect(), None)?,
            removed: stage(clamps, kernels::removed(), None)?,
            prepared,
            camera,
            settings,
            seed,
            indirect,
            tile_blocks,
            film,
            energy,
            irradiance,
            counter,
        })
    }
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

impl TileRenderer<'_> {
    /// Renders all tiles.
    pub fn render(
        &self,
        phases: &mut Phases,
        counts: &mut Counts,
        progress: Progress<'_>,
    ) -> Result<Image, GpuError> {
        let [width, height] = self.camera.size;
        let mut image =
            Image { width, height, pixels: vec![[0.0; 3]; width as usize * height as usize] };
        let (mut reflected, mut removed) = (0.0, 0.0);
        let all = image_blocks(self.camera);
        for first_block in (0..all).step_by(TILE_BLOCKS as usize) {
            let blocks = self.tile_blocks.min(all - first_block);
            self.prepared.gpu.clear(&[&self.film])?;
            self.prepared.gpu.clear(&self.energy.iter().collect::<Vec<_>>())?;
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
            let film: Vec<[f32; 4]> = self.prepared.gpu.read(&self.film, points)?;
            self.develop(first_block, &film, &mut image, counts);
            if let Some(energy) = &self.energy {
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
        phases.visible_points += self.run(&self.visible, &self.camera_params(tile), groups)?;
        for stage in self.show.iter().chain(&self.emit) {
            phases.shading += self.run(stage, &(), groups)?;
        }
        if self.direct_point.is_some() || self.direct_area.is_some() {
            progress(0.0, "direct light");
            self.clear_irradiance()?;
            phases.direct += self.direct(tile)?;
            phases.direct += self.reflect(groups)?;
        }
        if let Some(indirect) = &self.indirect {
            self.clear_irradiance()?;
            self.gather(tile, indirect, phases, counts, progress)?;
            phases.shading += self.reflect(groups)?;
            if let Some(stage) = &self.removed {
                phases.shading += self.run(stage, &(), groups)?;
            }
        }
        Ok(())
    }

    /// Direct light, in dispatches of a bounded number of shadow rays.
    fn direct(&self, tile: Tile) -> Result<Duration, GpuError> {
        let slice = (self.dispatch_rays() / tile.points()).max(1);
        let samples = self.settings.light_samples_per_point();
        let mut time = Duration::ZERO;
        let lights = &self.prepared.lights;
        let kinds = [
            (&self.direct_point, lights.point.len() as u32, lights.point.len() as u32),
            (&self.direct_area, lights.area.len() as u32, samples),
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
        let (Some(visibility), Some(shade)) = (&self.visibility, &self.shade) else {
            return Ok(());
        };
        let rows = tile.points();
        let words = indirect.count.div_ceil(32);
        let slice = (self.dispatch_rays() / (32 * rows)).max(1);
        // With subgroups a lane has four points.
        let groups = match self.prepared.gpu.has_subgroups() {
            true => rows.div_ceil(4 * 64),
            false => rows.div_ceil(64),
        };
        self.prepared.gpu.clear(&[&self.counter])?;
        for matrix_word in (0..words).step_by(MATRIX_WORDS as usize) {
            let matrix_words = MATRIX_WORDS.min(words - matrix_word);
            for start in (0..matrix_words).step_by(slice as usize) {
                progress(f64::from(matrix_word + start) / f64::from(words), "visibility");
                let params = VisibilityParams {
                    rows,
                    vpls: indirect.count,
                    first_word: matrix_word + start,
                    matrix_word,
                    offset: SURFACE_OFFSET,
                    nodes: self.prepared.bvh.nodes.len() as u32,
                    pad: [0; 2],
                };
                let across = [groups, slice.min(matrix_words - start)];
                phases.visibility += self.run(visibility, &params, across)?;
            }
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
        let [low, high]: [u32; 2] = self
            .prepared
            .gpu
            .read(&self.counter, 2)?
            .try_into()
            .map_err(|_| GpuError::Invalid("ray counter".to_owned()))?;
        counts.shadow_rays += u64::from(high) << 32 | u64::from(low);
        counts.shading_terms += u64::from(rows) * u64::from(indirect.count);
        Ok(())
    }

    fn reflect(&self, groups: [u32; 2]) -> Result<Duration, GpuError> {
        self.reflect.as_ref().map_or(Ok(Duration::ZERO), |stage| self.run(stage, &(), groups))
    }

    fn clear_irradiance(&self) -> Result<(), GpuError> {
        self.prepared.gpu.clear(&self.irradiance.iter().collect::<Vec<_>>())
    }

    fn run<P: bytemuck::Pod>(
        &self,
        stage: &Stage,
        params: &P,
        workgroups: [u32; 2],
    ) -> Result<Duration, GpuError> {
        if size_of::<P>() > 0 {
            self.prepared.gpu.write(&stage.params, std::slice::from_ref(params))?;
        }
        let (kernel, bindings) = (&*stage.kernel, &stage.bindings);
        self.prepared.gpu.run(&[Pass { kernel, bindings, workgroups }])
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

    /// Puts a tile's film into the image: means over the samples, blocks to rows.
    fn develop(&self, first_block: u32, film: &[[f32; 4]], image: &mut Image, counts: &mut Counts) {
        let unit = match self.settings.method {
            Method::Depth => self.prepared.scene.units.scale as f32,
            _ => 1.0,
        };
        let weight = unit / self.settings.samples as f32;
        for (point, texel) in (0..).zip(film) {
            let [x, y] = pixel_of(point, first_block, image.width);
            if x < image.width && y < image.height {
                let at = y as usize * image.width as usize + x as usize;
                image.pixels[at] = [texel[0], texel[1], texel[2]].map(|sum| sum * weight);
                counts.visible_points += texel[3] as u64;
            }
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

/// Blocks of 8 × 8 pixels that cover the image.
fn image_blocks(camera: &Camera) -> u32 {
    let [width, height] = camera.size;
    width.div_ceil(8) * height.div_ceil(8)
}

/// The pixel of a point; the twin of `pixel_of` in `shaders/sampling.wgsl`.
fn pixel_of(point: u32, first_block: u32, width: u32) -> [u32; 2] {
    let across = width.div_ceil(8);
    let block = first_block + point / BLOCK;
    let i = point % BLOCK;
    let x = (i & 1) | (i >> 1 & 2) | (i >> 2 & 4);
    let y = (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4);
    [block % across * 8 + x, block / across * 8 + y]
}
