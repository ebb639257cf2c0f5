//! Rays traced on the host and on the device, and shapes to trace them against.

use glam::Vec3;
use gpu_vpl::bvh::{Bvh, Ray};
use gpu_vpl::extremes::checks::trace::{self, Answers, World};
use gpu_vpl::scene::{Scene, Triangle};

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

pub fn random_rays(rng: &mut Rng, count: usize) -> Vec<Ray> {
    let one = |_| {
        let origin = rng.cube() * 1.5;
        let limit = if rng.bits().is_multiple_of(2) { f32::MAX } else { 3.0 * rng.unit() };
        Ray { origin, direction: rng.direction() * (0.1 + rng.unit()), limit }
    };
    (0..count).map(one).collect()
}
