//! Triangles and spheres.

use glam::Vec3;

/// A flat triangle. Its geometric normal is that of (v1 - v0) × (v2 - v0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// The corners.
    pub vertices: [Vec3; 3],
    /// Index into [`Scene::materials`](super::Scene::materials).
    pub material: u32,
}

impl Triangle {
    /// The geometric normal, its length twice the area.
    pub fn scaled_normal(&self) -> Vec3 {
        let [a, b, c] = self.vertices;
        (b - a).cross(c - a)
    }

    /// The area, in normalised units squared.
    pub fn area(&self) -> f32 {
        0.5 * self.scaled_normal().length()
    }
}

/// The colours of the corners of a triangle that has none.
pub const UNCOLORED: [Vec3; 3] = [Vec3::ONE; 3];

/// A sphere. Its normal points outwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// The centre.
    pub center: Vec3,
    /// The radius.
    pub radius: f32,
    /// Index into [`Scene::materials`](super::Scene::materials).
    pub material: u32,
}
