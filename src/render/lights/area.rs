//! Emitting triangles.

use std::f64::consts::PI;

use glam::Vec3;

use super::start::{Start, spawn_ray};
use super::table::{Share, Table, mean};
use crate::gpu::AreaLightRecord;
use crate::render::materials::hit::light_emission_scale;
use crate::render::virtual_light::VirtualLight;
use crate::sampling::{Sequence, cosine_hemisphere, uniform_triangle};
use crate::scene::Scene;

/// Those of a scene.
pub fn triangles(scene: &Scene) -> Table<AreaLightRecord> {
    let emitters: Vec<u32> = scene.emitters().collect();
    let power = |&index: &u32| {
        let triangle = &scene.triangles[index as usize];
        let material = &scene.materials[triangle.material as usize];
        let sides = if material.two_sided { 2.0 } else { 1.0 };
        sides * PI * f64::from(triangle.area()) * mean(material.emission)
    };
    Table::of(&emitters, power, |&index, Share { before, probability }| {
        let triangle = &scene.triangles[index as usize];
        let material = &scene.materials[triangle.material as usize];
        let [a, b, c] = triangle.vertices;
        AreaLightRecord {
            corner: a.to_array(),
            before,
            edge1: (b - a).to_array(),
            probability,
            edge2: (c - a).to_array(),
            two_sided: u32::from(material.two_sided),
            normal: triangle.scaled_normal().normalize().to_array(),
            area: triangle.area(),
            radiance: material.emission.to_array(),
            pad: 0.0,
        }
    })
}

/// A place on the triangle, and by what the radiance there is multiplied.
fn place(scene: &Scene, light: &AreaLightRecord, triangle: u32, u: [f32; 2]) -> (Vec3, Vec3) {
    let [b, c] = uniform_triangle(u);
    let [corner, edge1, edge2] = [light.corner, light.edge1, light.edge2].map(Vec3::from_array);
    (corner + edge1 * b + edge2 * c, light_emission_scale(scene, triangle, [1.0 - b - c, b, c]))
}

/// A place uniform on the triangle, a direction by the cosine; `side` is another random number.
pub fn start(
    scene: &Scene,
    light: &AreaLightRecord,
    triangle: u32,
    side: f32,
    [a, b, u, v]: [f32; 4],
) -> Start {
    let two_sided = light.two_sided != 0;
    let normal = Vec3::from_array(light.normal);
    let normal = if two_sided && side < 0.5 { -normal } else { normal };
    let sides = if two_sided { 2.0 } else { 1.0 };
    let direction = cosine_hemisphere(normal, [u, v]);
    let (position, glow) = place(scene, light, triangle, [a, b]);
    // L cos θ over the density of position and direction.
    let flux = Vec3::from_array(light.radiance) * glow * (PI as f32 * light.area * sides);
    Start { ray: spawn_ray(position, normal, direction), flux }
}

/// `count` places on the triangles of `emitters`, chosen by power and then uniform, as lights that together give the light of all.
pub fn places(
    scene: &Scene,
    table: &Table<AreaLightRecord>,
    emitters: &[u32],
    count: u32,
    seed: u32,
) -> Vec<VirtualLight> {
    let sequence = Sequence::new(seed);
    let mut lights = Vec::new();
    for index in 0..count {
        let draw = |dimension| sequence.sample(index, dimension);
        let Some((index, probability, rest)) = table.index_at(f64::from(draw(0))) else { break };
        let light = &table.records[index];
        let (position, glow) = place(scene, light, emitters[index], [rest, draw(1)]);
        let normal = Vec3::from_array(light.normal);
        // L cos θ over the density of light and position, of which there are `count`.
        let share = light.area / (probability * count as f32);
        let intensity = Vec3::from_array(light.radiance) * glow * share;
        lights.push(VirtualLight::diffuse(position, normal, intensity));
        if light.two_sided != 0 {
            lights.push(VirtualLight::diffuse(position, -normal, intensity));
        }
    }
    lights
}
