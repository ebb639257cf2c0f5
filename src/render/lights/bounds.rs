//! A sphere around the scene, through which light comes from infinitely far away.

use std::f32::consts::PI;

use glam::Vec3;

use crate::bvh::Ray;
use crate::sampling::{on_disk, uniform_disk};
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

    /// The sphere about another centre that holds this one.
    pub fn around(&self, center: Vec3) -> Self {
        // A little more, for rounding.
        Self { center, radius: (self.radius + center.distance(self.center)) * 1.000_01 }
    }

    /// The area of a disc across it.
    pub fn area(&self) -> f64 {
        std::f64::consts::PI * f64::from(self.radius).powi(2)
    }

    /// The random numbers with which a ray of [`Bounds::ray_along`] goes through a place.
    pub fn place_across(&self, direction: Vec3, position: Vec3) -> [f32; 2] {
        on_disk(direction, (position - self.center) / self.radius)
    }

    /// A ray along a unit direction from outside of the sphere, uniform on the disc across it, and
    /// the disc's area.
    pub fn ray_along(&self, direction: Vec3, u: [f32; 2]) -> (Ray, f32) {
        let origin = self.center + self.radius * (uniform_disk(direction, u) - direction);
        (Ray { origin, direction, limit: f32::MAX }, PI * self.radius * self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Sequence, uniform_sphere};

    #[test]
    fn rays_go_through_the_places_that_they_are_drawn_for() {
        let of_scene = Bounds { center: Vec3::new(0.1, -0.2, 0.3), radius: 1.5 };
        let sequence = Sequence::new(9);
        for i in 0..4096 {
            let draw = |d| sequence.sample(i, d);
            let within = |d| 0.999 * uniform_sphere([draw(d), draw(d + 1)]) * draw(d + 2).cbrt();
            let [focus, position] = [0, 3].map(|d| of_scene.center + of_scene.radius * within(d));
            let direction = uniform_sphere([draw(6), draw(7)]);
            let bounds = of_scene.around(focus);
            let (ray, area) = bounds.ray_along(direction, bounds.place_across(direction, position));
            let missed = (position - ray.origin).reject_from_normalized(direction).length();
            assert!(missed < 2e-6 * bounds.radius, "{position} is missed by {missed}");
            assert!(ray.origin.distance(of_scene.center) > of_scene.radius, "it starts inside");
            assert!(area >= PI * of_scene.radius * of_scene.radius);
        }
    }
}
