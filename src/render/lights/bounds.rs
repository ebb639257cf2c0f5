//! A sphere around the scene, through which light comes from infinitely far away.

use std::f32::consts::PI;

use glam::Vec3;

use crate::bvh::Ray;
use crate::sampling::uniform_disk;
use crate::scene::Scene;

/// A sphere that holds all shapes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Bounds {
    /// Its centre: that of a box around them.
    pub center: Vec3,
    /// Its radius.
    pub radius: f32,
}

impl Bounds {
    /// Around the shapes of a scene.
    pub fn of(scene: &Scene) -> Self {
        let corners = || scene.triangles.iter().flat_map(|triangle| triangle.vertices);
        let spheres = || scene.spheres.iter();
        let extremes = spheres().flat_map(|s| [s.center - s.radius, s.center + s.radius]);
        let (low, high) = corners()
            .chain(extremes)
            .fold((Vec3::MAX, Vec3::MIN), |(low, high), p| (low.min(p), high.max(p)));
        let center = 0.5 * (low + high);
        let reach = corners()
            .map(|corner| corner.distance(center))
            .chain(spheres().map(|sphere| sphere.center.distance(center) + sphere.radius))
            .fold(0.0, f32::max);
        // A little more, for rounding.
        Self { center, radius: reach * 1.000_01 }
    }

    /// A ray along a unit direction from outside of the sphere, uniform on the disc across it, and
    /// the disc's area.
    pub fn ray_along(&self, direction: Vec3, u: [f32; 2]) -> (Ray, f32) {
        let origin = self.center + self.radius * (uniform_disk(direction, u) - direction);
        (Ray { origin, direction, limit: f32::MAX }, PI * self.radius * self.radius)
    }
}
