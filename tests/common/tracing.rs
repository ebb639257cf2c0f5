//! Rays traced on the host and on the device, and shapes to trace them against.

use glam::{Mat3, Vec3};
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::scene::{Scene, Triangle};
use gpu_vpl::study::extremes::checks::trace::{self, Answers, World};

use super::Rng;

pub fn world_of_triangles(bvh: &Bvh) -> World {
    World::of_triangles(super::gpu(), bvh).unwrap()
}

pub fn world_of(scene: &Scene) -> World {
    World::of(super::gpu(), scene).unwrap()
}

/// The host, and all ways to trace on the device.
pub fn on_all(bvh: &Bvh, rays: &[Ray], any: bool) -> Answers {
    on_all_of(&world_of_triangles(bvh), rays, any)
}

pub fn on_all_of(world: &World, rays: &[Ray], any: bool) -> Answers {
    trace::on_all(super::gpu(), world, rays, any).unwrap()
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
