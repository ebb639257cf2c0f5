//! Rays traced on the host and on the device, and shapes to trace them against.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{Mat3, Vec3};
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::gpu::module::{CORNERS, LITERAL_RAY, RAY, TRAVERSE, TRAVERSE_PACKET, TYPES};
use gpu_vpl::gpu::{Module, Pass, PointRecord, Program};
use gpu_vpl::render::literals::meet;
use gpu_vpl::scene::Triangle;

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

/// What either side answers: `triangle` is `NOTHING` without a hit.
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

/// More triangles take long to compile as literals; the renderer stops long before.
const MOST_LITERALS: usize = 220;

/// The ways to trace on this device: ray by ray, in packets where it has subgroups, and against
/// literals if they are few.
pub fn on_device(bvh: &Bvh, rays: &[Ray], any: bool) -> Vec<(&'static str, Vec<Answer>)> {
    let mut sides = vec![("device", with(&[&TRAVERSE], None, bvh, rays, any))];
    if super::gpu().has_subgroups() {
        sides.push(("device, packets", with(&[&TRAVERSE_PACKET], None, bvh, rays, any)));
    }
    if bvh.triangles.len() <= MOST_LITERALS {
        let text = Some(meet(&bvh.triangles).into());
        let answers = with(&[&LITERAL_RAY, &CORNERS], text, bvh, rays, any);
        sides.push(("device, literals", answers));
    }
    sides
}

fn with(
    traverse: &[&'static Module],
    generated: Option<Arc<str>>,
    bvh: &Bvh,
    rays: &[Ray],
    any: bool,
) -> Vec<Answer> {
    let gpu = super::gpu();
    let modules = [&[&TYPES, &RAY][..], traverse, &[&TRACE]].concat();
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
    let buffers = [
        ("params", &params),
        ("nodes", &gpu.storage_of("nodes", &bvh.nodes).unwrap()),
        ("triangles", &gpu.storage_of("triangles", &bvh.triangles).unwrap()),
        ("rays", &gpu.storage_of("rays", &rays).unwrap()),
        ("hits", &hits),
    ];
    let bindings = gpu.bind(&kernel, &buffers).unwrap();
    gpu.run(&[Pass { kernel: &kernel, bindings: &bindings, workgroups: [count.div_ceil(64), 1] }])
        .unwrap();
    gpu.read(&hits, rays.len()).unwrap()
}

/// The host and [`on_device`].
pub fn on_all(bvh: &Bvh, rays: &[Ray], any: bool) -> Vec<(&'static str, Vec<Answer>)> {
    let mut sides = vec![("host", on_host(bvh, rays, any))];
    sides.extend(on_device(bvh, rays, any));
    sides
}

pub fn on_host(bvh: &Bvh, rays: &[Ray], any: bool) -> Vec<Answer> {
    let miss = Answer { triangle: PointRecord::NOTHING, ..Answer::zeroed() };
    let trace = |ray: &Ray| match (any, bvh.closest(ray)) {
        (true, _) if bvh.occluded(ray) => Answer::zeroed(),
        (false, Some(h)) => {
            let (weights, t, triangle, material) = (h.weights, h.t, h.triangle, h.material);
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
