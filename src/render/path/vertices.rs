//! The vertices of a wave of paths, and the queue of those that go on.

use crate::gpu::{GpuError, PathParams, PathRecord, PointRecord};
use crate::render::camera::{Attribute, attributes};
use crate::render::kernels::path as programs;
use crate::render::prepared::Prepared;
use crate::render::stage::{Named, Stage};

/// Paths of a run of the queue that counts its survivors.
const RUN: u32 = 64;

/// The buffers of a wave of paths.
#[derive(Debug)]
pub struct Vertices {
    /// Where the paths are.
    pub points: wgpu::Buffer,
    /// What else is known of those places.
    pub attributes: Vec<Attribute>,
    /// What the paths have found; in w, how many shadow rays they took.
    pub radiance: wgpu::Buffer,
    states: wgpu::Buffer,
    queue: wgpu::Buffer,
    survivors: wgpu::Buffer,
}

impl Vertices {
    /// Of so many paths.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(prepared: &Prepared, paths: usize) -> Result<Self, GpuError> {
        let gpu = &prepared.gpu;
        Ok(Self {
            points: gpu.storage::<PointRecord>("vertices", paths)?,
            attributes: attributes(gpu, prepared.features, paths)?,
            radiance: gpu.storage::<[f32; 4]>("radiance", paths)?,
            states: gpu.storage::<PathRecord>("paths", paths)?,
            queue: gpu.storage::<u32>("queue", paths)?,
            survivors: gpu.storage::<u32>("survivors", paths)?,
        })
    }

    /// These and the scene's, by name.
    pub fn named<'a>(&'a self, prepared: &'a Prepared) -> Vec<Named<'a>> {
        let own = [
            ("points", &self.points),
            ("radiance", &self.radiance),
            ("paths", &self.states),
            ("queue", &self.queue),
            ("survivors", &self.survivors),
        ];
        let attributes = self.attributes.iter().map(|(name, buffer)| (*name, buffer));
        own.into_iter().chain(attributes).chain(prepared.named()).collect()
    }
}

/// Makes the queue of the paths that go on.
#[derive(Debug)]
pub struct Queue {
    /// How many paths of each run go on.
    counts: wgpu::Buffer,
    /// Where in the queue they go.
    places: wgpu::Buffer,
    count: Stage,
    compact: Stage,
}

impl Queue {
    /// Of so many paths.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        vertices: &[Named<'_>],
        paths: usize,
    ) -> Result<Self, GpuError> {
        let runs = paths.div_ceil(RUN as usize);
        let words = |label: &str| prepared.gpu.storage::<u32>(label, runs);
        let (counts, places) = (words("counts")?, words("places")?);
        let own = [("counts", &counts), ("places", &places)];
        let named = [vertices, &own].concat();
        let count = Stage::new(prepared, &programs::count(), &named)?;
        let compact = Stage::new(prepared, &programs::compact(), &named)?;
        Ok(Self { counts, places, count, compact })
    }

    /// Makes the queue of the paths that go on, of those that `params` counts; how many they are.
    ///
    /// # Errors
    /// The device fails.
    pub fn survivors(&self, prepared: &Prepared, params: &PathParams) -> Result<u32, GpuError> {
        let runs = params.paths.div_ceil(RUN);
        let groups = [runs.div_ceil(64), 1];
        self.count.run(prepared, params, groups)?;
        let mut places: Vec<u32> = prepared.gpu.read(&self.counts, runs as usize)?;
        let mut all = 0;
        for place in &mut places {
            all += std::mem::replace(place, all);
        }
        prepared.gpu.write(&self.places, &places)?;
        self.compact.run(prepared, params, groups)?;
        Ok(all)
    }
}
