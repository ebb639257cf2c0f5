//! The passes of paths, with the buffers of a wave bound to them.

use crate::gpu::{CameraParams, GpuError, PathParams, PathRecord, PathSum, PointRecord, Program};
use crate::render::kernels::path as programs;
use crate::render::stages::{Named, Stage, keep};
use crate::render::{Prepared, Settings};

/// Paths of a run of the queue that counts its survivors.
pub const RUN: u32 = 64;

/// What a wave of paths works on that the host reads or writes.
#[derive(Debug)]
pub struct Buffers {
    /// How many paths of each run go on.
    pub counts: wgpu::Buffer,
    /// Where in the queue they go.
    pub places: wgpu::Buffer,
    /// What the samples of each pixel came to.
    pub sums: wgpu::Buffer,
}

/// The passes.
#[derive(Debug)]
pub struct Stages {
    /// See there.
    pub buffers: Buffers,
    /// Camera rays.
    pub camera: Stage,
    /// Emission towards the camera.
    pub emit: Vec<Stage>,
    /// Shadow rays to one of so many lights: area lights, point lights.
    pub lights: Vec<(Stage, u32)>,
    /// The next segment, for the next vertex or for the light that it happens upon.
    pub segment: Option<Stage>,
    /// Which paths go on.
    pub count: Stage,
    /// The queue of those.
    pub compact: Stage,
    /// Samples to pixels.
    pub sum: Stage,
}

impl Stages {
    /// Allocates for waves of so many paths of so many pixels, and binds what the settings need.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        settings: &Settings,
        paths: usize,
        pixels: usize,
    ) -> Result<Self, GpuError> {
        let gpu = &prepared.gpu;
        let words = |label: &str, count: usize| gpu.storage::<u32>(label, count);
        let runs = paths.div_ceil(RUN as usize);
        let points = gpu.storage::<PointRecord>("vertices", paths)?;
        let radiance = gpu.storage::<[f32; 4]>("radiance", paths)?;
        let states = gpu.storage::<PathRecord>("paths", paths)?;
        let (queue, survivors) = (words("queue", paths)?, words("survivors", paths)?);
        let buffers = Buffers {
            counts: words("counts", runs)?,
            places: words("places", runs)?,
            sums: gpu.storage::<PathSum>("sums", pixels)?,
        };
        let kept = keep(gpu, prepared.features, paths)?;
        let tables = prepared.tables.iter().chain(&kept).map(|(name, of)| (*name, of));
        let own: [Named<'_>; 9] = [
            ("points", &points),
            ("radiance", &radiance),
            // What is emitted towards the camera is a path's first radiance.
            ("film", &radiance),
            ("paths", &states),
            ("queue", &queue),
            ("survivors", &survivors),
            ("counts", &buffers.counts),
            ("places", &buffers.places),
            ("sums", &buffers.sums),
        ];
        let named: &[Named<'_>] =
            &own.into_iter().chain(tables).chain(prepared.environment()).collect::<Vec<_>>();
        let bind = |program: Program| Stage::new(prepared, &program, named);
        let target = prepared.target();
        let mut lights = Vec::new();
        if programs::seeks_light(settings) {
            for (kind, table) in &prepared.light_tables {
                let named = [named, &[("lights", table)]].concat();
                if let Some(program) = programs::next_event(target, *kind) {
                    let stage = Stage::new(prepared, &program, &named)?;
                    lights.push((stage, prepared.lights.count(*kind)));
                }
            }
        }
        let areas = prepared.lights.have_surfaces();
        let emit = programs::emitted(prepared).into_iter().map(bind);
        let emit = emit.collect::<Result<_, GpuError>>()?;
        let segment = programs::has_segments(prepared, settings)
            .then(|| bind(programs::segment(target, settings.bounces, areas)));
        Ok(Self {
            camera: bind(programs::camera(target))?,
            emit,
            lights,
            segment: segment.transpose()?,
            count: bind(programs::count())?,
            compact: bind(programs::compact())?,
            sum: bind(programs::sum())?,
            buffers,
        })
    }
}

// The buffer of a stage's parameters has room for the largest.
const _: () = assert!(size_of::<PathParams>() <= size_of::<CameraParams>());
