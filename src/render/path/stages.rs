//! The stages of paths, with the buffers of a wave bound to them.

use super::vertices::{Queue, Vertices};
use crate::gpu::{CameraParams, GpuError, PathParams, PathSum, Program};
use crate::render::kernels::path as programs;
use crate::render::lights::LightKind;
use crate::render::prepared::Prepared;
use crate::render::settings::Settings;
use crate::render::stage::{Named, Stage};

/// The stages.
#[derive(Debug)]
pub struct Stages {
    /// What the samples of each pixel came to.
    pub sums: wgpu::Buffer,
    /// Camera rays.
    pub camera: Stage,
    /// Emission towards the camera.
    pub emit: Vec<Stage>,
    /// Shadow rays to one of so many lights: area lights, point lights.
    pub lights: Vec<(Stage, u32)>,
    /// The next segment, for the next vertex or for the light that it happens upon.
    pub segment: Option<Stage>,
    /// Which paths go on.
    pub queue: Queue,
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
        let vertices = Vertices::new(prepared, paths)?;
        let sums = prepared.gpu.storage::<PathSum>("sums", pixels)?;
        let mut named = vertices.named(prepared);
        // What is emitted towards the camera is a path's first radiance.
        named.extend([("film", &vertices.radiance), ("sums", &sums)]);
        let bind = |program: Program| Stage::new(prepared, &program, &named);
        let target = prepared.target();
        let lights = match programs::seeks_light(settings) {
            true => next_event(prepared, &named, &|kind| programs::next_event(target, kind))?,
            false => Vec::new(),
        };
        let areas = prepared.lights.have_surfaces();
        let emit = prepared.path_emission_programs().into_iter().map(bind);
        let emit = emit.collect::<Result<_, GpuError>>()?;
        let segment = prepared
            .has_segments(settings)
            .then(|| bind(programs::segment(target, settings.bounces, areas)));
        Ok(Self {
            camera: bind(programs::camera(target))?,
            emit,
            lights,
            segment: segment.transpose()?,
            queue: Queue::new(prepared, &named, paths)?,
            sum: bind(programs::sum())?,
            sums,
        })
    }
}

/// The stages that seek the lights of each kind, by their programs, and how many lights those are.
///
/// # Errors
/// The device refuses.
pub fn next_event(
    prepared: &Prepared,
    named: &[Named<'_>],
    program: &dyn Fn(LightKind) -> Option<Program>,
) -> Result<Vec<(Stage, u32)>, GpuError> {
    let mut stages = Vec::new();
    for kind in prepared.kinds_with_tables() {
        if let Some(program) = program(kind) {
            let named = [&prepared.exact_lights(kind)[..], named].concat();
            let stage = Stage::new(prepared, &program, &named)?;
            stages.push((stage, prepared.lights.count(kind)));
        }
    }
    Ok(stages)
}

// The buffer of a stage's parameters has room for the largest.
const _: () = assert!(size_of::<PathParams>() <= size_of::<CameraParams>());
