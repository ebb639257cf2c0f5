//! Lights without extent: alike in all directions, and spots.

use std::f64::consts::PI;

use glam::Vec3;

use super::start::Start;
use super::table::{Share, Table, mean};
use crate::bvh::Ray;
use crate::gpu::{PointLightRecord, SpotLightRecord};
use crate::sampling::{uniform_cone, uniform_sphere};
use crate::scene::{Cone, PointLight, Scene};

/// Those of a scene that shine in all directions.
pub fn points(scene: &Scene) -> Table<PointLightRecord> {
    let lights: Vec<_> = scene.point_lights.iter().filter(|light| light.cone.is_none()).collect();
    let power = |light: &&PointLight| 4.0 * PI * mean(light.intensity);
    Table::of(&lights, power, |light, Share { before, probability }| PointLightRecord {
        position: light.position.to_array(),
        before,
        intensity: light.intensity.to_array(),
        probability,
    })
}

/// The spots of a scene.
pub fn spots(scene: &Scene) -> Table<SpotLightRecord> {
    let with_cone = |light: &PointLight| Some((*light, light.cone?));
    let lights: Vec<_> = scene.point_lights.iter().filter_map(with_cone).collect();
    let power = |(light, cone): &(PointLight, Cone)| mean(light.intensity) * solid_angle(cone);
    Table::of(&lights, power, |(light, cone), Share { before, probability }| SpotLightRecord {
        position: light.position.to_array(),
        before,
        intensity: light.intensity.to_array(),
        probability,
        axis: cone.axis.to_array(),
        cos_outer: cone.cos_outer,
        slope: 1.0 / (cone.cos_inner - cone.cos_outer),
        pad: [0; 3],
    })
}

/// The integral of the square of the ramp over all directions.
fn solid_angle(cone: &Cone) -> f64 {
    let (inner, outer) = (f64::from(cone.cos_inner), f64::from(cone.cos_outer));
    2.0 * PI * (1.0 - inner + (inner - outer) / 3.0)
}

/// A direction uniform on the sphere.
pub fn start_of_point(light: &PointLightRecord, [_, _, u, v]: [f32; 4]) -> Start {
    let direction = uniform_sphere([u, v]);
    let ray = Ray { origin: Vec3::from_array(light.position), direction, limit: f32::MAX };
    Start { ray, flux: Vec3::from_array(light.intensity) * (4.0 * PI) as f32 }
}

/// A direction uniform in the cone.
pub fn start_of_spot(light: &SpotLightRecord, [_, _, u, v]: [f32; 4]) -> Start {
    let width = 1.0 - light.cos_outer;
    let direction = uniform_cone(Vec3::from_array(light.axis), width, [u, v]);
    let ray = Ray { origin: Vec3::from_array(light.position), direction, limit: f32::MAX };
    Start { ray, flux: light.intensity_towards(direction) * (2.0 * PI as f32 * width) }
}

impl SpotLightRecord {
    /// The intensity in a unit direction. The twin of the function in `shaders/lights/spot_light.wgsl`.
    pub fn intensity_towards(&self, direction: Vec3) -> Vec3 {
        let cosine = direction.dot(Vec3::from_array(self.axis));
        let ramp = ((cosine - self.cos_outer) * self.slope).clamp(0.0, 1.0);
        Vec3::from_array(self.intensity) * (ramp * ramp)
    }
}
