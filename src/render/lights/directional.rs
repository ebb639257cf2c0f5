//! Lights infinitely far away.

use std::f64::consts::PI;

use glam::Vec3;

use super::bounds::Bounds;
use super::start::Start;
use super::table::{Share, Table, mean};
use crate::gpu::DirectionalLightRecord;
use crate::scene::{DirectionalLight, Scene};

/// Those of a scene. Their power is what goes through the disc across a sphere around it.
pub fn directional(scene: &Scene, bounds: &Bounds) -> Table<DirectionalLightRecord> {
    let area = PI * f64::from(bounds.radius).powi(2);
    let power = |light: &DirectionalLight| mean(light.irradiance) * area;
    Table::of(&scene.directional_lights, power, |light, Share { before, probability }| {
        DirectionalLightRecord {
            toward: (-light.direction).to_array(),
            before,
            irradiance: light.irradiance.to_array(),
            probability,
        }
    })
}

/// The irradiance across its direction, mean of the channels.
pub fn irradiance(light: &DirectionalLightRecord) -> f64 {
    mean(Vec3::from_array(light.irradiance))
}

/// A place uniform on the disc.
pub fn start(light: &DirectionalLightRecord, bounds: &Bounds, [u, v, ..]: [f32; 4]) -> Start {
    let (ray, area) = bounds.ray_along(-Vec3::from_array(light.toward), [u, v]);
    Start { ray, flux: Vec3::from_array(light.irradiance) * area }
}
