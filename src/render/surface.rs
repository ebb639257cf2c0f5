//! What a ray on the host has hit: the twin of `shaders/hit_point.wgsl`.

use glam::{Vec2, Vec3};

use crate::bvh::Hit;
use crate::scene::{Scene, texture};

/// A place on a surface, on the side from which a ray came.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Where it is.
    pub position: Vec3,
    /// Unit geometric normal of that side.
    pub normal: Vec3,
    /// Whether that side is the front.
    pub front: bool,
    /// Diffuse reflectance there.
    pub albedo: Vec3,
    /// Index of the material.
    pub material: u32,
}

impl Surface {
    /// What a ray of this direction has hit.
    pub fn of(scene: &Scene, hit: &Hit, direction: Vec3) -> Self {
        let (position, normal) = place(scene, hit);
        let front = normal.dot(direction) <= 0.0;
        let material = &scene.materials[hit.material as usize];
        let texture = material.texture.map_or(Vec3::ONE, |texture| {
            let uv = texture_coordinates(scene, hit);
            scene.textures[texture as usize].sample(&scene.images, uv).truncate()
        });
        Self {
            position,
            normal: if front { normal } else { -normal },
            front,
            albedo: material.albedo * texture,
            material: hit.material,
        }
    }
}

/// Where a hit is, and the unit normal of the front.
fn place(scene: &Scene, hit: &Hit) -> (Vec3, Vec3) {
    match scene.triangles.get(hit.shape as usize) {
        Some(triangle) => {
            let [a, b, c] = triangle.vertices;
            let position = a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2];
            (position, triangle.scaled_normal().normalize())
        }
        None => {
            let sphere = &scene.spheres[hit.shape as usize - scene.triangles.len()];
            let normal = Vec3::from_array(hit.weights);
            (sphere.center + sphere.radius * normal, normal)
        }
    }
}

fn texture_coordinates(scene: &Scene, hit: &Hit) -> Vec2 {
    match (hit.shape as usize) < scene.triangles.len() {
        true => texture::on_triangle(scene.uvs[hit.shape as usize], hit.weights),
        false => texture::on_sphere(Vec3::from_array(hit.weights)),
    }
}
