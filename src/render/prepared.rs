//! What is done once for a scene and a device: tables uploaded, kernels compiled.

mod compiled;
pub mod tables;

use std::ops::Deref;
use std::sync::Arc;
use std::time::{Duration, Instant};

use super::lights::LightKind;
use super::plan::Plan;
use super::settings::Settings;
use crate::gpu::{Gpu, GpuError, Kernel, Program, Texture};
use crate::scene::{Environment, Scene};
use compiled::CompiledKernels;

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
    kernels: CompiledKernels,
    tables: Vec<tables::Table>,
    /// Those that packets of rays are traced through.
    pub textures: Vec<Texture>,
    /// The lights of each kind that have no extent.
    pub light_tables: Vec<(LightKind, wgpu::Buffer)>,
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
        let mut prepared = Self {
            tables: tables::upload(&gpu, &plan.scene, &plan.bvh, plan.features)?,
            textures: textures(&gpu, &plan)?,
            light_tables: plan
                .kinds_with_tables()
                .filter_map(|kind| {
                    let table = plan.lights.upload_exact(&gpu, kind).transpose()?;
                    Some(table.map(|table| (kind, table)))
                })
                .collect::<Result<_, GpuError>>()?,
            kernels: CompiledKernels::default(),
            pipelines_time: Duration::ZERO,
            gpu,
            plan,
        };
        prepared.compile(settings)?;
        prepared.pipelines_time = start.elapsed().saturating_sub(prepared.bvh_time);
        Ok(prepared)
    }

    /// Compiles what settings need.
    fn compile(&self, settings: &Settings) -> Result<(), GpuError> {
        self.programs(settings).into_iter().try_for_each(|program| {
            self.kernels.get(&self.gpu, program)?;
            Ok(())
        })
    }

    /// The kernel of a program, compiled at most once.
    ///
    /// # Errors
    /// The device refuses.
    pub fn kernel(&self, program: Program) -> Result<Arc<Kernel>, GpuError> {
        self.kernels.get(&self.gpu, self.complete(program))
    }

    /// The buffers of the scene, by the names by which shaders know them.
    pub fn named(&self) -> impl Iterator<Item = (&str, &wgpu::Buffer)> {
        self.tables.iter().map(|(name, of)| (*name, of))
    }

    /// The lights of a kind without extent, by the name by which shaders know them; nothing for
    /// others.
    pub fn exact_lights(&self, kind: LightKind) -> Vec<(&str, &wgpu::Buffer)> {
        let lights = self.light_tables.iter().filter(|(other, _)| *other == kind);
        lights.map(|(_, table)| ("lights", table)).collect()
    }

    /// Bytes of the scene's tables on the device.
    pub fn table_bytes(&self) -> u64 {
        let lights = self.light_tables.iter().map(|(_, buffer)| buffer);
        let tables = self.tables.iter().map(|(_, buffer)| buffer).chain(lights);
        let buffers = tables.map(wgpu::Buffer::size);
        buffers.chain(self.textures.iter().map(|texture| texture.bytes)).sum()
    }

    /// Features that no shader module linked so far serves.
    pub fn left_out(&self) -> Vec<&'static str> {
        self.kernels.left_out()
    }
}

/// The tables of the scene that are in textures.
///
/// # Errors
/// They do not fit.
fn textures(gpu: &Gpu, plan: &Plan) -> Result<Vec<Texture>, GpuError> {
    let mut textures = match &plan.wide {
        Some(wide) => tables::of_packets(gpu, &plan.bvh, wide)?,
        None => Vec::new(),
    };
    for kind in plan.kinds_with_tables() {
        textures.extend(plan.lights.upload_extended(gpu, kind)?);
    }
    if let (Some(Environment { image: Some(image), .. }), true) =
        (&plan.scene.environment, plan.features.sky.shines())
    {
        textures.push(gpu.texture_of("environment_texels", &image.texels)?);
    }
    Ok(textures)
}

impl Deref for Prepared {
    type Target = Plan;

    fn deref(&self) -> &Plan {
        &self.plan
    }
}
