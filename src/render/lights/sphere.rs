//! Emitting spheres.

use std::f64::consts::PI;

use glam::Vec3;

use super::start::{Start, spawn_ray};
use super::table::{Share, Table, mean};
use crate::gpu::SphereLightRecord;
use crate::sampling::{cosine_hemisphere, uniform_sphere};
use crate::scene::{Scene, Sphere};

/// Those of a scene.
pub fn spheres(scene: &Scene) -> Table<SphereLightRecord> {
    let material = |sphere: &Sphere| &scene.materials[sphere.material as usize];
    let lights: Vec<&Sphere> = scene.spheres.iter().filter(|of| material(of).emits()).collect();
    let power = |sphere: &&Sphere| {
        let sides = if material(sphere).two_sided { 2.0 } else { 1.0 };
        let radius = f64::from(sphere.radius);
        sides * PI * 4.0 * PI * radius * radius * mean(material(sphere).emission)
    };
    Table::of(&lights, power, |sphere, Share { before, probability }| SphereLightRecord {
        center: sphere.center.to_array(),
        radius: sphere.radius,
        radiance: material(sphere).emission.to_array(),
        two_sided: u32::from(material(sphere).two_sided),
        before,
        probability,
        pad: [0; 2],
    })
}

/// A place uniform on the sphere, a direction by the cosine; `side` is another random number.
pub fn start(light: &SphereLightRecord, side: f32, [a, b, u, v]: [f32; 4]) -> Start {
    let two_sided = light.two_sided != 0;
    let outward = uniform_sphere([a, b]);
    let position = Vec3::from_array(light.center) + outward * light.radius;
    let normal = if two_sided && side < 0.5 { -outward } else { outward };
    let sides = if two_sided { 2.0 } else { 1.0 };
    let direction = cosine_hemisphere(normal, [u, v]);
    // L cos θ over the density of position and direction.
    let area = 4.0 * PI as f32 * light.radius * light.radius;
    let flux = Vec3::from_array(light.radiance) * (PI as f32 * area * sides);
    Start { ray: spawn_ray(position, normal, direction), flux }
}
