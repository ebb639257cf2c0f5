//! The pipeline: what is prepared once, and the passes of a frame in their order.

mod bound;
mod camera_rays;
mod compensate;
mod direct;
mod features;
mod film;
mod frame;
mod gather;
mod gathers;
mod interleave;
pub mod kernels;
mod light;
mod light_set;
pub mod literals;
mod merge;
mod path;
mod picture;
mod plan;
pub mod scatter;
mod settings;
mod stages;
mod surface;
pub mod tables;
mod tile;
mod visibility;
mod visible;
mod vpl;

use std::ops::Deref;
use std::time::{Duration, Instant};

use crate::gpu::{Gpu, GpuError};
use crate::scene::{Camera, Environment, Scene};

pub use features::{Features, Sky, Target};
pub use frame::{Counts, Frame, Phases};
pub use kernels::{Kernels, all_programs};
pub use light::{LightKind, Lights};
pub use plan::Plan;
pub use settings::{
    Bounces, Clamp, Clustering, Direct, Merge, Method, Representative, Settings, SettingsError,
};
pub use vpl::{LightPaths, Vpl};

pub use gather::chunk_words;
use gathers::{Clustered, Gathers};
use light_set::LightSet;
pub use merge::{Gloss, VirtualLight, VplClusters};
use path::PathTracer;
use stages::Named;
use tile::TileRenderer;

/// Everything that does not change from frame to frame: scene, BVH and lights, which are the
/// [`Plan`], and device, kernels and the buffers of the scene.
#[derive(Debug)]
pub struct Prepared {
    /// What is known without the device.
    plan: Plan,
    /// The device.
    pub gpu: Gpu,
    /// Time spent on linking and compiling shaders, and on uploading the scene.
    pub pipelines_time: Duration,
    kernels: Kernels,
    tables: Vec<tables::Table>,
    light_tables: Vec<(LightKind, wgpu::Buffer)>,
    environment_texels: Option<wgpu::Buffer>,
}

impl Prepared {
    /// Builds the BVH, uploads the scene, and links the shaders that the scene and the
    /// settings need. Frames with other settings link what more they need.
    ///
    /// # Errors
    /// The device fails, or the scene does not fit it.
    pub fn new(gpu: Gpu, scene: Scene, settings: &Settings) -> Result<Self, GpuError> {
        tables::check(&gpu, &scene, Plan::features(&scene, settings))?;
        let start = Instant::now();
        let plan = Plan::new(scene, settings, gpu.has_subgroups());
        let lights = &plan.lights;
        let mut prepared = Self {
            tables: tables::upload(&gpu, &plan.scene, &plan.bvh, plan.features)?,
            light_tables: plan
                .kinds_with_tables()
                .map(|kind| Ok((kind, lights.upload(&gpu, kind)?)))
                .collect::<Result<_, GpuError>>()?,
            environment_texels: match &plan.scene.environment {
                Some(Environment { image: Some(image), .. }) if plan.features.sky.shines() => {
                    Some(gpu.storage_of("environment image", &image.texels)?)
                }
                _ => None,
            },
            kernels: Kernels::default(),
            pipelines_time: Duration::ZERO,
            gpu,
            plan,
        };
        prepared.kernels.prepare(&prepared, settings)?;
        prepared.pipelines_time = start.elapsed().saturating_sub(prepared.bvh_time);
        Ok(prepared)
    }

    /// The buffers of the environment, by name.
    fn environment(&self) -> impl Iterator<Item = Named<'_>> {
        let is = |(kind, _): &&(LightKind, wgpu::Buffer)| *kind == LightKind::Environment;
        let table = self.light_tables.iter().find(is).map(|(_, table)| ("environment", table));
        let texels = self.environment_texels.iter().map(|buffer| ("environment_texels", buffer));
        table.into_iter().chain(texels)
    }

    /// Bytes of the scene's buffers on the device.
    pub fn table_bytes(&self) -> u64 {
        let lights = self.light_tables.iter().map(|(_, buffer)| buffer);
        let tables = self.tables.iter().map(|(_, buffer)| buffer).chain(lights);
        tables.chain(&self.environment_texels).map(wgpu::Buffer::size).sum()
    }

    /// Features that no shader module linked so far serves.
    pub fn left_out(&self) -> Vec<&'static str> {
        self.kernels.left_out()
    }
}

impl Deref for Prepared {
    type Target = Plan;

    fn deref(&self) -> &Plan {
        &self.plan
    }
}

/// Told about the progress of a frame: the fraction done, in [0, 1], and the phase.
pub type Progress<'a> = &'a dyn Fn(f64, &'static str);

/// Renders one frame of a prepared scene.
///
/// # Errors
/// The device fails or runs out of memory.
pub fn frame(
    prepared: &Prepared,
    camera: &Camera,
    settings: &Settings,
    seed: u32,
    progress: Progress<'_>,
) -> Result<Frame, GpuError> {
    if settings.method == Method::Path {
        return PathTracer::new(prepared, camera, settings, seed)?.render(progress);
    }
    let mut phases = Phases::default();
    let mut counts = Counts::default();

    progress(0.0, "light paths");
    let start = Instant::now();
    let vpls = light_paths(prepared, settings, seed);
    counts.vpls = vpls.len() as u64;
    counts.truncated_fraction = vpl::truncated_fraction(&vpls, settings.bounces, &prepared.scene);
    let bound = bound::of(prepared, settings, &vpls);
    let scale = prepared.scene.units.scale;
    counts.clamp = bound.map(|bound| f64::from(bound) / (scale * scale));
    let lights: Vec<_> = vpls.iter().map(|vpl| VirtualLight::of(vpl, &prepared.scene)).collect();
    phases.vpls = start.elapsed();
    let (lights, columns) = clustered_vpls(lights, settings, seed, &mut phases, &mut counts);

    let gathered = if settings.method.is_indirect() { &lights[..] } else { &[] };
    let subsets = if settings.interleaves() { settings.interleave.pow(2) } else { 1 };
    let indirect = LightSet::new(prepared, gathered, columns.as_ref(), bound, subsets)?;
    let mut renderer = TileRenderer::new(prepared, camera, settings, seed, indirect.as_ref())?;
    if let Some(bound) = bound.filter(|_| settings.compensates()) {
        renderer.give_back(&vpls, bound)?;
    }
    let shared = indirect.is_some() || settings.direct == Direct::Clustered;
    let shown = settings.method == Method::PointClusters;
    let clustered = match settings.method.clusters_points() && (shared || shown) {
        true => {
            let probes = if settings.probes() { settings.clustering.probes } else { 0 };
            let probes = spread(&lights, probes as usize);
            renderer.cluster(&probes, &mut phases, &mut counts, progress)?
        }
        false => None,
    };
    counts.point_clusters = clustered.as_ref().map(Clustered::count);
    let gathers = Gathers {
        indirect: indirect.map(|lights| renderer.gather(lights, clustered.as_ref())).transpose()?,
        direct: match &clustered {
            Some(clustered) => renderer.gather_direct(clustered)?,
            None => Vec::new(),
        },
    };
    gathers.trace_clusters(&mut phases, &mut counts, progress)?;
    let mut image =
        renderer.render(&gathers, clustered.as_ref(), &mut phases, &mut counts, progress)?;
    match (settings.method, &clustered) {
        (Method::PointClusters, Some(clustered)) => picture::point_clusters(clustered, &mut image),
        (Method::VplMap, _) => picture::lights(prepared, camera, &lights, 1.0, &mut image),
        (Method::VplClustersMap, _) => picture::lights(prepared, camera, &lights, 3.5, &mut image),
        _ => {}
    }
    let passes = prepared.gpu.take_pass_times()?;
    Ok(Frame { image, standard_error: None, counts, phases, passes })
}

/// The lights to gather, and the clusters whose visibility they share, if they share any.
fn clustered_vpls(
    lights: Vec<VirtualLight>,
    settings: &Settings,
    seed: u32,
    phases: &mut Phases,
    counts: &mut Counts,
) -> (Vec<VirtualLight>, Option<VplClusters>) {
    if !settings.method.clusters_vpls() {
        return (lights, None);
    }
    let start = Instant::now();
    let clusters = VplClusters::of(&lights, &settings.clustering, seed);
    counts.vpl_clusters = Some(clusters.lights.len() as u64);
    phases.cluster_vpls = start.elapsed();
    match settings.clustering.merge {
        Merge::Visibility if settings.method.is_indirect() => (lights, Some(clusters)),
        _ => (clusters.lights, None),
    }
}

/// The VPLs that the settings ask for.
pub fn light_paths(prepared: &Prepared, settings: &Settings, seed: u32) -> Vec<Vpl> {
    if !settings.method.traces_paths() {
        return Vec::new();
    }
    LightPaths {
        scene: &prepared.scene,
        bvh: &prepared.bvh,
        lights: &prepared.lights,
        count: settings.light_paths,
        bounces: settings.bounces,
        seed,
    }
    .trace()
}

/// So many of the lights, evenly spaced in their order.
fn spread(lights: &[VirtualLight], count: usize) -> Vec<VirtualLight> {
    let count = count.min(lights.len());
    (0..count).map(|i| lights[i * lights.len() / count]).collect()
}
