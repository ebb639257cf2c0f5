//! The passes of paths, with the buffers of a wave bound to them.

use crate::gpu::{CameraParams, GpuError, PathParams, PathRecord, PathSum, PointRecord, Program};
use crate::render::kernels::{self, Purpose, Traversal, path as programs};
use crate::render::stages::{Named, Stage};
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
    pub emit: Option<Stage>,
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
        let named: &[Named<'_>] = &[
            ("nodes", &prepared.nodes),
            ("triangles", &prepared.triangles),
            ("materials", &prepared.materials),
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
        let bind = |program: Program| Stage::new(prepared, &program, named);
        let [nearest, shadow] =
            [Purpose::Nearest, Purpose::Shadow].map(|purpose| Traversal::of(prepared, purpose));
        let mut lights = Vec::new();
        if programs::seeks_light(settings) {
            let table = &prepared.lights;
            let kinds = [
                (&prepared.area_lights, programs::area(&shadow), table.area.len()),
                (&prepared.point_lights, programs::point(&shadow), table.point.len()),
            ];
            for (buffer, program, count) in kinds {
                if let Some(buffer) = buffer {
                    let named = [named, &[("lights", buffer)]].concat();
                    lights.push((Stage::new(prepared, &program, &named)?, count as u32));
                }
            }
        }
        let areas = prepared.area_lights.is_some();
        let emit = prepared.area_lights.as_ref().map(|_| bind(kernels::emit())).transpose()?;
        let segment = programs::has_segments(settings, areas)
            .then(|| bind(programs::segment(&nearest, settings.bounces, areas)));
        Ok(Self {
            camera: bind(programs::camera(&nearest))?,
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
