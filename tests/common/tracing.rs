//! Rays traced on the host and on the device, and shapes to trace them against.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{Mat3, Vec3};
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::gpu::module::{
    CORNERS, LITERAL_RAY, RAY, SHAPE_TRIANGLE, TRAVERSE, TRAVERSE_PACKET, TYPES,
};
use gpu_vpl::gpu::{Module, Pass, PointRecord, Program};
use gpu_vpl::render::Features;
use gpu_vpl::render::kernels::shapes;
use gpu_vpl::render::literals::{Literals, meet};
use gpu_vpl::render::tables::{self, Table};
use gpu_vpl::scene::{Scene, Triangle};

use super::Rng;

static TRACE: Module =
    Module { name: "traversal", source: include_str!("../traversal.wgsl"), feature: None };

#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct TestRay {
    origin: [f32; 3],
    limit: f32,
    direction: [f32; 3],
    pad: u32,
}

#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct TestParams {
    rays: u32,
    nodes: u32,
    any: u32,
    pad: u32,
}

/// What either side answers: `triangle`, or the sphere after them, is `NOTHING` without a hit.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Answer {
    pub weights: [f32; 3],
    pub t: f32,
    pub triangle: u32,
    pub material: u32,
    pub pad: [u32; 2],
}

impl Answer {
    pub fn hits(&self) -> bool {
        self.triangle != PointRecord::NOTHING
    }
}

/// What rays are traced through: a hierarchy, and its tables on the device.
pub struct World {
    pub bvh: Bvh,
    pub features: Features,
    pub tables: Vec<Table>,
    /// All triangles, if they are few.
    pub literals: Option<Literals>,
}

impl World {
    pub fn of_triangles(bvh: &Bvh) -> Self {
        let gpu = super::gpu();
        let tables = vec![
            ("nodes", gpu.storage_of("nodes", &bvh.nodes).unwrap()),
            ("triangles", gpu.storage_of("triangles", &bvh.triangles).unwrap()),
        ];
        let literals = Literals::of_triangles(&bvh.triangles, &[], true);
        Self { bvh: bvh.clone(), features: Features::default(), tables, literals }
    }

    pub fn of(scene: &Scene) -> Self {
        let (bvh, features) = (Bvh::of(scene), Features::of(scene));
        let tables = tables::upload(super::gpu(), scene, &bvh, features).unwrap();
        Self { bvh, features, tables, literals: None }
    }

    pub fn named(&self) -> impl Iterator<Item = (&str, &wgpu::Buffer)> {
        self.tables.iter().map(|(name, buffer)| (*name, buffer))
    }
}

/// More triangles take long to compile as literals; the renderer stops long before.
const MOST_LITERALS: usize = 220;

/// The ways to trace on this device: ray by ray, in packets where it has subgroups, and against
/// literals if they are few triangles alone.
pub fn on_device(world: &World, rays: &[Ray], any: bool) -> Vec<(&'static str, Vec<Answer>)> {
    let with = |modules: &[&'static Module], text| with(modules, text, world, rays, any);
    let shapes = shapes(world.features);
    let of_nodes = |traverse| [&shapes[..], &[traverse]].concat();
    let mut sides = vec![("device", with(&of_nodes(&TRAVERSE), None))];
    if super::gpu().has_subgroups() {
        sides.push(("device, packets", with(&of_nodes(&TRAVERSE_PACKET), None)));
    }
    let plain = world.features == Features::default();
    if plain && world.bvh.triangles.len() <= MOST_LITERALS {
        let text = Some(meet(&world.bvh.triangles).into());
        let modules = [&RAY, &SHAPE_TRIANGLE, &LITERAL_RAY, &CORNERS];
        sides.push(("device, literals", with(&modules, text)));
    }
    sides
}

fn with(
    traverse: &[&'static Module],
    generated: Option<Arc<str>>,
    world: &World,
    rays: &[Ray],
    any: bool,
) -> Vec<Answer> {
    let (gpu, bvh) = (super::gpu(), &world.bvh);
    let modules = [&[&TYPES][..], traverse, &[&TRACE]].concat();
    let program = Program { label: "test rays", modules, generated };
    let kernel = gpu.compile(&program).unwrap();
    let of = |ray: &Ray| {
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        TestRay { origin, limit: ray.limit, direction, pad: 0 }
    };
    let rays: Vec<TestRay> = rays.iter().map(of).collect();
    let (count, nodes) = (rays.len() as u32, bvh.nodes.len() as u32);
    let params = gpu.parameters::<TestParams>("params").unwrap();
    gpu.write(&params, &[TestParams { rays: count, nodes, any: u32::from(any), pad: 0 }]).unwrap();
    let hits = gpu.storage::<Answer>("hits", rays.len()).unwrap();
    let rays_buffer = gpu.storage_of("rays", &rays).unwrap();
    let own = [("params", &params), ("rays", &rays_buffer), ("hits", &hits)];
    let buffers: Vec<_> = own.into_iter().chain(world.named()).collect();
    let bindings = gpu.bind(&kernel, &buffers).unwrap();
    gpu.run(&[Pass { kernel: &kernel, bindings: &bindings, workgroups: [count.div_ceil(64), 1] }])
        .unwrap();
    gpu.read(&hits, rays.len()).unwrap()
}

/// The host and [`on_device`].
pub fn on_all(bvh: &Bvh, rays: &[Ray], any: bool) -> Vec<(&'static str, Vec<Answer>)> {
    on_all_of(&World::of_triangles(bvh), rays, any)
}

pub fn on_all_of(world: &World, rays: &[Ray], any: bool) -> Vec<(&'static str, Vec<Answer>)> {
    let mut sides = vec![("host", on_host(&world.bvh, rays, any))];
    sides.extend(on_device(world, rays, any));
    sides
}

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

pub fn triangle(vertices: [Vec3; 3]) -> Triangle {
    Triangle { vertices, material: 3 }
}

pub fn soup(rng: &mut Rng, count: usize, size: f32) -> Vec<Triangle> {
    let one = |_| {
        let center = rng.cube();
        triangle([0; 3].map(|_| center + size * rng.cube()))
    };
    (0..count).map(one).collect()
}

/// The surface of a cube, each face of n × n quads, turned and moved.
pub fn cube(n: u32, turn: Mat3) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let at = |i: u32, j: u32| {
                let mut p = [0.0; 3];
                let on = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, on(i), on(j));
                turn * (0.8 * Vec3::from_array(p))
            };
            for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
                let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                triangles.push(triangle([quad[0], quad[1], quad[2]]));
                triangles.push(triangle([quad[0], quad[2], quad[3]]));
            }
        }
    }
    triangles
}

pub fn random_rays(rng: &mut Rng, count: usize) -> Vec<Ray> {
    let one = |_| {
        let origin = rng.cube() * 1.5;
        let limit = if rng.bits().is_multiple_of(2) { f32::MAX } else { 3.0 * rng.unit() };
        Ray { origin, direction: rng.direction() * (0.1 + rng.unit()), limit }
    };
    (0..count).map(one).collect()
}
