//! Shadow rays between points and lights: a bit each, word by word of 32 lights.

use std::cell::Cell;
use std::time::{Duration, Instant};

use crate::gpu::{GpuError, VisibilityParams};
use crate::render::kernels::Emitter;
use crate::render::prepared::Prepared;
use crate::render::result::Phases;
use crate::render::stage::{Named, Stage};
use crate::sampling::SURFACE_OFFSET;

/// Shadow rays of a dispatch, at most, where they are fast and where they are slow.
const DISPATCH_RAYS: u32 = 1 << 23;
const DISPATCH_RAYS_LARGE: u32 = 1 << 21;
/// Scenes of more BVH nodes are slow.
const LARGE_SCENE_NODES: usize = 4096;
/// Shadow rays that an invocation traces in a dispatch at first: all of a word, or so many that
/// llvmpipe's bound on the rounds of loops is hardly ever met.
const RAYS_AT_ONCE: u32 = 32;
const RAYS_AT_ONCE_LARGE: u32 = 16;

/// Traces the shadow rays of a set of lights.
#[derive(Debug)]
pub struct Tracer<'a> {
    pub(super) prepared: &'a Prepared,
    /// Words of lights in all, for progress.
    words: u32,
    pub(super) counter: wgpu::Buffer,
    /// Shadow rays that an invocation traces in a dispatch; halved where a driver cuts their
    /// loops short.
    rays_at_once: Cell<u32>,
}

/// How the words of a set of lights are dealt to dispatches.
pub(super) struct Slices<'a> {
    /// Words in a dispatch, at most.
    pub words: u32,
    /// Workgroups over so many rows and words.
    pub groups: &'a dyn Fn(u32, u32) -> [u32; 2],
    /// As [`Tracer::rays_at_once`].
    pub rays_at_once: &'a Cell<u32>,
    /// What each needs first.
    pub before: &'a dyn Fn(&VisibilityParams) -> Result<(), GpuError>,
}

/// How many shadow rays a dispatch may trace without taking many seconds.
pub fn dispatch_rays(prepared: &Prepared) -> u32 {
    if is_large(prepared) { DISPATCH_RAYS_LARGE } else { DISPATCH_RAYS }
}

/// Words of lights that a dispatch over so many rows may have.
pub(super) fn words_at_once(prepared: &Prepared, rows: u32) -> u32 {
    (dispatch_rays(prepared) / (32 * rows.max(1))).max(1)
}

fn is_large(prepared: &Prepared) -> bool {
    prepared.bvh.nodes.len() > LARGE_SCENE_NODES
}

impl<'a> Tracer<'a> {
    /// For so many words of lights in all.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(prepared: &'a Prepared, words: u32) -> Result<Self, GpuError> {
        let counter = prepared.gpu.storage::<u32>("ray counter", 3)?;
        let rays_at_once = if is_large(prepared) { RAYS_AT_ONCE_LARGE } else { RAYS_AT_ONCE };
        Ok(Self { prepared, words, counter, rays_at_once: Cell::new(rays_at_once) })
    }

    /// Binds the buffers of a stage: points, lights and the bits that are written.
    ///
    /// # Errors
    /// The device refuses.
    pub fn stage(&self, emitter: Emitter, buffers: &[Named<'_>]) -> Result<Stage, GpuError> {
        let buffers = [buffers, &[("counter", &self.counter)]].concat();
        Stage::new(self.prepared, &self.prepared.visibility_program(emitter), &buffers)
    }

    /// The parameters for so many rows and a run of words.
    pub fn params(&self, rows: u32, first_word: u32, words: u32) -> VisibilityParams {
        VisibilityParams {
            rows,
            // What fills the last word up has no normal, and no ray is traced to it.
            vpls: 32 * (first_word + words),
            first_word,
            matrix_word: first_word,
            offset: SURFACE_OFFSET,
            nodes: self.prepared.bvh.nodes.len() as u32,
            first: 0,
            count: 32,
            first_point: 0,
            words,
            seed: 0,
            pad: 0,
        }
    }

    /// Traces the shadow rays of so many words, in dispatches of a bounded number.
    ///
    /// # Errors
    /// The device fails.
    pub fn trace(
        &self,
        visibility: &Stage,
        params: VisibilityParams,
        words: u32,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let points = 64 * self.prepared.tracing().points();
        let slices = Slices {
            words: words_at_once(self.prepared, params.rows),
            groups: &|rows, words| [rows.div_ceil(points), words],
            rays_at_once: &self.rays_at_once,
            before: &|_| Ok(()),
        };
        let params = VisibilityParams { words, ..params };
        self.trace_slices(visibility, params, &slices, phases, progress)
    }

    /// The same with `before` run for each run of words, and workgroups and rays at once as they say.
    ///
    /// # Errors
    /// The device fails.
    pub(super) fn trace_slices(
        &self,
        visibility: &Stage,
        params: VisibilityParams,
        slices: &Slices<'_>,
        phases: &mut Phases,
        progress: &dyn Fn(f64),
    ) -> Result<u64, GpuError> {
        let start = Instant::now();
        let mut rays = 0;
        for offset in (0..params.words).step_by(slices.words as usize) {
            let first_word = params.matrix_word + offset;
            progress(f64::from(first_word) / f64::from(self.words));
            let words = slices.words.min(params.words - offset);
            let params = VisibilityParams { first_word, words, ..params };
            (slices.before)(&params)?;
            let groups = (slices.groups)(params.rows, words);
            rays += self.trace_words(visibility, params, groups, slices.rays_at_once)?;
        }
        phases.visibility += start.elapsed();
        Ok(rays)
    }

    /// Traces the shadow rays of some words, in as many dispatches as it takes for every loop
    /// to come to its end: some drivers bound the rounds of an invocation's loops. Returns how
    /// many rays there were.
    fn trace_words(
        &self,
        visibility: &Stage,
        params: VisibilityParams,
        groups: [u32; 2],
        at_once: &Cell<u32>,
    ) -> Result<u64, GpuError> {
        let gpu = &self.prepared.gpu;
        loop {
            let count = at_once.get();
            gpu.clear(&[&self.counter])?;
            for first in (0..32).step_by(count as usize) {
                let params = VisibilityParams { first, count, ..params };
                let _: Duration = visibility.run(self.prepared, &params, groups)?;
            }
            let counter: Vec<u32> = gpu.read(&self.counter, 3)?;
            match counter[..] {
                [low, high, 0] => return Ok(u64::from(high) << 32 | u64::from(low)),
                _ if count > 1 => at_once.set(count / 2),
                _ => return Err(GpuError::LoopCut),
            }
        }
    }
}
