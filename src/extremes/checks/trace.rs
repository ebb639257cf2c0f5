//! Rays traced on the host and, in every way there is, on the device.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};

use crate::bvh::{Bvh, Ray, WideBvh};
use crate::gpu::{Dispatch, Gpu, GpuError, Module, PointRecord, Program, Texture};
use crate::render::Features;
use crate::render::kernels::catalogue::{
    HIT_TRIANGLES, LITERALS, RAY, SHAPE_TRIANGLE, TABLE, TRAVERSE, TRAVERSE_PACKET, TYPES,
    WIDE_NODES,
};
use crate::render::kernels::literals::{Literals, meet};
use crate::render::kernels::shapes;
use crate::render::prepared::tables::{self, Table};
use crate::scene::Scene;

static TRACE: Module = Module { name: "trace", source: include_str!("trace.wgsl"), feature: None };

#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct TraceRay {
    origin: [f32; 3],
    limit: f32,
    direction: [f32; 3],
    pad: u32,
}

#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct TraceParams {
    rays: u32,
    nodes: u32,
    any: u32,
    pad: u32,
}

/// What either side answers.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Answer {
    /// Of a triangle's corners; of a sphere, its normal.
    pub weights: [f32; 3],
    /// Distance, in lengths of the ray's direction.
    pub t: f32,
    /// The triangle in the scene, or the sphere after them; `NOTHING` without a hit.
    pub triangle: u32,
    /// Index of its material.
    pub material: u32,
    /// Nothing.
    pub pad: [u32; 2],
}

impl Answer {
    /// Whether anything was hit.
    pub fn hits(&self) -> bool {
        self.triangle != PointRecord::NOTHING
    }
}

/// The answers of each way to trace, by its name.
pub type Answers = Vec<(&'static str, Vec<Answer>)>;

/// What rays are traced through: a hierarchy, and its tables on the device.
#[derive(Debug)]
pub struct World {
    /// The hierarchy.
    pub bvh: Bvh,
    /// What the scene has.
    pub features: Features,
    /// On the device.
    pub tables: Vec<Table>,
    /// What packets go through, on the device.
    pub textures: Vec<Texture>,
    /// All triangles, if they are few.
    pub literals: Option<Literals>,
}

impl World {
    /// Of triangles alone.
    ///
    /// # Errors
    /// The device refuses.
    pub fn of_triangles(gpu: &Gpu, bvh: &Bvh) -> Result<Self, GpuError> {
        let tables = vec![
            ("nodes", gpu.storage_of("nodes", &bvh.nodes)?),
            ("triangles", gpu.storage_of("triangles", &bvh.triangles)?),
        ];
        let literals = Literals::of_triangles(&bvh.triangles, &[], true);
        let textures = tables::of_packets(gpu, bvh, &WideBvh::of(bvh))?;
        Ok(Self { bvh: bvh.clone(), features: Features::default(), tables, textures, literals })
    }

    /// Of a scene.
    ///
    /// # Errors
    /// The device refuses.
    pub fn of(gpu: &Gpu, scene: &Scene) -> Result<Self, GpuError> {
        let (bvh, features) = (Bvh::of(scene), Features::of(scene));
        let tables = tables::upload(gpu, scene, &bvh, features)?;
        let textures = tables::of_packets(gpu, &bvh, &WideBvh::of(&bvh))?;
        Ok(Self { bvh, features, tables, textures, literals: None })
    }

    /// Its buffers, by name.
    pub fn named(&self) -> impl Iterator<Item = (&str, &wgpu::Buffer)> {
        self.tables.iter().map(|(name, buffer)| (*name, buffer))
    }
}

/// More triangles take long to compile as literals; the renderer stops long before.
const MOST_LITERALS: usize = 220;

/// The ways to trace on this device: ray by ray, in packets where it has subgroups, and against
/// literals if they are few triangles alone.
///
/// # Errors
/// The device fails.
pub fn on_device(gpu: &Gpu, world: &World, rays: &[Ray], any: bool) -> Result<Answers, GpuError> {
    let with = |modules: &[&'static Module], text| with(gpu, modules, text, world, rays, any);
    let shapes = shapes(world.features);
    let of_nodes = |traverse: &[&'static Module]| [&shapes[..], traverse].concat();
    let mut sides = vec![("device", with(&of_nodes(&[&TRAVERSE]), None)?)];
    if gpu.has_subgroups() {
        sides.push((
            "device, packets",
            with(&of_nodes(&[&TABLE, &WIDE_NODES, &TRAVERSE_PACKET]), None)?,
        ));
    }
    let plain = world.features == Features::default();
    if plain && world.bvh.triangles.len() <= MOST_LITERALS {
        let text = Some(meet(&world.bvh.triangles).into());
        let modules = [&RAY, &SHAPE_TRIANGLE, &LITERALS, &HIT_TRIANGLES];
        sides.push(("device, literals", with(&modules, text)?));
    }
    Ok(sides)
}

fn with(
    gpu: &Gpu,
    traverse: &[&'static Module],
    generated: Option<Arc<str>>,
    world: &World,
    rays: &[Ray],
    any: bool,
) -> Result<Vec<Answer>, GpuError> {
    let modules = [&[&TYPES][..], traverse, &[&TRACE]].concat();
    let program = Program { label: "rays of a check", modules, generated };
    let kernel = gpu.compile(&program)?;
    let of = |ray: &Ray| {
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        TraceRay { origin, limit: ray.limit, direction, pad: 0 }
    };
    let rays: Vec<TraceRay> = rays.iter().map(of).collect();
    let (count, nodes) = (rays.len() as u32, world.bvh.nodes.len() as u32);
    let params = gpu.parameters::<TraceParams>("params")?;
    gpu.write(&params, &[TraceParams { rays: count, nodes, any: u32::from(any), pad: 0 }])?;
    let hits = gpu.storage::<Answer>("hits", rays.len())?;
    let rays_buffer = gpu.storage_of("rays", &rays)?;
    let own = [("params", &params), ("rays", &rays_buffer), ("hits", &hits)];
    let buffers: Vec<_> = own.into_iter().chain(world.named()).collect();
    let textures: Vec<_> = world.textures.iter().map(|texture| (texture.name, texture)).collect();
    let bindings = gpu.bind_with(&kernel, &buffers, &textures)?;
    gpu.run(&[Dispatch {
        kernel: &kernel,
        bindings: &bindings,
        workgroups: [count.div_ceil(64), 1],
    }])?;
    gpu.read(&hits, rays.len())
}

/// On the host.
pub fn on_host(bvh: &Bvh, rays: &[Ray], any: bool) -> Vec<Answer> {
    let miss = Answer { triangle: PointRecord::NOTHING, ..Answer::zeroed() };
    let trace = |ray: &Ray| match (any, bvh.closest(ray)) {
        (true, _) if bvh.occluded(ray) => Answer::zeroed(),
        (false, Some(h)) => {
            let (weights, t, triangle, material) = (h.weights, h.t, h.shape, h.material);
            Answer { weights, t, triangle, material, pad: [0; 2] }
        }
        _ => miss,
    };
    rays.iter().map(trace).collect()
}

/// The host and [`on_device`].
///
/// # Errors
/// The device fails.
pub fn on_all(gpu: &Gpu, world: &World, rays: &[Ray], any: bool) -> Result<Answers, GpuError> {
    let mut sides = vec![("host", on_host(&world.bvh, rays, any))];
    sides.extend(on_device(gpu, world, rays, any)?);
    Ok(sides)
}
