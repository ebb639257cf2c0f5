//! What a ray on the host has hit: the twin of `shaders/hit_point.wgsl`.

use glam::Vec3;

use crate::bvh::Hit;
use crate::scene::Scene;

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
        let triangle = &scene.triangles[hit.triangle as usize];
        let [a, b, c] = triangle.vertices;
        let normal = triangle.scaled_normal().normalize();
        let front = normal.dot(direction) <= 0.0;
        Self {
            position: a * hit.weights[0] + b * hit.weights[1] + c * hit.weights[2],
            normal: if front { normal } else { -normal },
            front,
            albedo: scene.materials[hit.material as usize].albedo,
            material: hit.material,
        }
    }
}
