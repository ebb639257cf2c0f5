//! Rays, and where they meet shapes.

use glam::Vec3;

/// A ray or segment; `direction` need not be of unit length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
    /// Hits are sought at 0 < t < limit, in lengths of `direction`.
    pub limit: f32,
}

/// Where a ray meets a shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f32,
    /// Index of the triangle in the scene; from the number of triangles on, of the sphere.
    pub shape: u32,
    /// Index of its material.
    pub material: u32,
    /// Barycentric weights of a triangle's corners; of a sphere, the unit normal outwards.
    pub weights: [f32; 3],
}
