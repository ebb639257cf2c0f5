//! Where light paths start.

use glam::Vec3;

use crate::bvh::Ray;
use crate::sampling::SURFACE_OFFSET;

/// The first segment of a light path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// Where it starts and goes.
    pub ray: Ray,
    /// What it carries: of one path, drawn with certainty from this light.
    pub flux: Vec3,
}

/// A ray from a surface.
pub fn spawn_ray(position: Vec3, normal: Vec3, direction: Vec3) -> Ray {
    Ray { origin: position + normal * SURFACE_OFFSET, direction, limit: f32::MAX }
}
