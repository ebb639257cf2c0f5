//! The light sources as tables to draw from, for direct light and for light paths.

use std::f32::consts::PI;

use glam::Vec3;

use super::merge::VirtualLight;
use super::surface::light_glow;
use crate::gpu::{AreaLightRecord, Gpu, GpuError, PointLightRecord};
use crate::sampling::{Sequence, uniform_triangle};
use crate::scene::Scene;

/// The kinds of light sources, each with a table and passes of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightKind {
    /// Lights without extent.
    Point,
    /// Emitting triangles.
    Area,
}

impl LightKind {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Point, Self::Area];
}

/// All lights of a scene.
#[derive(Debug, Clone, Default)]
pub struct Lights {
    /// Emitting triangles; their probabilities are proportional to power and sum to one.
    pub area: Vec<AreaLightRecord>,
    /// Lights without extent.
    pub point: Vec<PointLightRecord>,
    /// The triangles that they are, by their indices in the scene.
    pub emitters: Vec<u32>,
    /// Flux of all area lights, mean of the channels.
    area_power: f64,
    /// Running sums of the point lights' flux.
    point_power: Vec<f64>,
}

/// A light drawn with a probability proportional to its power.
#[derive(Debug, Clone, Copy)]
pub struct Choice<'a> {
    /// The light.
    pub light: LightRef<'a>,
    /// Its probability among all lights.
    pub probability: f32,
    /// What is left of the random number, uniform in [0, 1).
    pub rest: f32,
}

/// One light of [`Lights`].
#[derive(Debug, Clone, Copy)]
pub enum LightRef<'a> {
    /// An emitting triangle, and its index in the scene.
    Area(&'a AreaLightRecord, u32),
    /// A light without extent.
    Point(&'a PointLightRecord),
}

impl Lights {
    /// The lights of a scene.
    pub fn of(scene: &Scene) -> Self {
        let emitters: Vec<u32> = scene.emitters().collect();
        let power = |&index: &u32| {
            let triangle = &scene.triangles[index as usize];
            let material = &scene.materials[triangle.material as usize];
            let sides = if material.two_sided { 2.0 } else { 1.0 };
            sides * f64::from(PI * triangle.area()) * mean(material.emission)
        };
        let area_power: f64 = emitters.iter().map(power).sum();
        let mut before = 0.0;
        let area = emitters
            .iter()
            .map(|index| {
                let record = area_light(scene, *index, before, power(index) / area_power);
                before += f64::from(record.probability);
                record
            })
            .collect();
        let mut sum = 0.0;
        let point_power: Vec<f64> = scene
            .point_lights
            .iter()
            .map(|light| {
                sum += f64::from(4.0 * PI) * mean(light.intensity);
                sum
            })
            .collect();
        let mut before = 0.0;
        let point = scene
            .point_lights
            .iter()
            .zip(&point_power)
            .map(|(light, &up_to)| {
                let record = PointLightRecord {
                    position: light.position.to_array(),
                    before: (before / sum) as f32,
                    intensity: light.intensity.to_array(),
                    probability: ((up_to - before) / sum) as f32,
                };
                before = up_to;
                record
            })
            .collect();
        Self { area, point, emitters, area_power, point_power }
    }

    /// How many lights of a kind there are.
    pub fn count(&self, kind: LightKind) -> u32 {
        match kind {
            LightKind::Point => self.point.len() as u32,
            LightKind::Area => self.area.len() as u32,
        }
    }

    /// The kinds of which there are lights.
    pub fn kinds(&self) -> impl Iterator<Item = LightKind> + '_ {
        LightKind::ALL.into_iter().filter(|&kind| self.count(kind) > 0)
    }

    /// The table of a kind on the device.
    ///
    /// # Errors
    /// It does not fit.
    pub fn upload(&self, gpu: &Gpu, kind: LightKind) -> Result<wgpu::Buffer, GpuError> {
        match kind {
            LightKind::Point => gpu.storage_of("point lights", &self.point),
            LightKind::Area => gpu.storage_of("area lights", &self.area),
        }
    }

    /// The probability density, by area, of a place on an area light, over the mean of its radiance
    /// and the number of its sides; 0 without area lights.
    pub fn area_density(&self) -> f32 {
        if self.area.is_empty() { 0.0 } else { (f64::from(PI) / self.area_power) as f32 }
    }

    /// The index of the area light whose interval of probability holds `u`, and where in it.
    fn area_at(&self, u: f64) -> (usize, f32) {
        let at = self.area.partition_point(|l| f64::from(l.before) <= u).saturating_sub(1);
        let light = &self.area[at];
        (at, unit((u - f64::from(light.before)) / f64::from(light.probability)))
    }

    /// `count` places on the area lights, chosen by power and then uniform, as lights that
    /// together give the light of all.
    pub fn places(&self, scene: &Scene, count: u32, seed: u32) -> Vec<VirtualLight> {
        let sequence = Sequence::new(seed);
        let places = if self.area.is_empty() { 0 } else { count };
        let mut lights = Vec::new();
        for index in 0..places {
            let draw = |dimension| sequence.sample(index, dimension);
            let (index, rest) = self.area_at(f64::from(draw(0)));
            let light = &self.area[index];
            let [b, c] = uniform_triangle([rest, draw(1)]);
            let [corner, edge1, edge2, normal, radiance] =
                [light.corner, light.edge1, light.edge2, light.normal, light.radiance]
                    .map(Vec3::from_array);
            let glow = light_glow(scene, self.emitters[index], [1.0 - b - c, b, c]);
            // L cos θ over the pdf of light and position, of which there are `count`.
            let intensity = radiance * glow * (light.area / (light.probability * count as f32));
            let position = corner + edge1 * b + edge2 * c;
            lights.push(VirtualLight::diffuse(position, normal, intensity));
            if light.two_sided != 0 {
                lights.push(VirtualLight::diffuse(position, -normal, intensity));
            }
        }
        lights
    }

    /// The point lights, as lights without a surface.
    pub fn points(&self) -> Vec<VirtualLight> {
        let light = |light: &PointLightRecord| {
            let [position, intensity] = [light.position, light.intensity].map(Vec3::from_array);
            VirtualLight::diffuse(position, Vec3::ZERO, intensity)
        };
        self.point.iter().map(light).collect()
    }

    /// Draws a light by power; none if no light has any.
    pub fn choose(&self, u: f32) -> Option<Choice<'_>> {
        let point_power = self.point_power.last().copied().unwrap_or(0.0);
        let total = self.area_power + point_power;
        if total.is_nan() || total <= 0.0 {
            return None;
        }
        let target = f64::from(u) * total;
        if target < self.area_power || self.point.is_empty() {
            let share = self.area_power / total;
            let (at, rest) = self.area_at((target / self.area_power).min(1.0));
            let light = &self.area[at];
            let probability = (share * f64::from(light.probability)) as f32;
            return Some(Choice {
                light: LightRef::Area(light, self.emitters[at]),
                probability,
                rest,
            });
        }
        let target = target - self.area_power;
        let at = self.point_power.partition_point(|&sum| sum <= target).min(self.point.len() - 1);
        let before = if at == 0 { 0.0 } else { self.point_power[at - 1] };
        let power = self.point_power[at] - before;
        let rest = unit((target - before) / power);
        let light = LightRef::Point(&self.point[at]);
        Some(Choice { light, probability: (power / total) as f32, rest })
    }
}

fn area_light(scene: &Scene, index: u32, before: f64, probability: f64) -> AreaLightRecord {
    let triangle = &scene.triangles[index as usize];
    let material = &scene.materials[triangle.material as usize];
    let [a, b, c] = triangle.vertices;
    AreaLightRecord {
        corner: a.to_array(),
        before: before as f32,
        edge1: (b - a).to_array(),
        probability: probability as f32,
        edge2: (c - a).to_array(),
        two_sided: u32::from(material.two_sided),
        normal: triangle.scaled_normal().normalize().to_array(),
        area: triangle.area(),
        radiance: material.emission.to_array(),
        pad: 0.0,
    }
}

/// Rounding may leave the remainder a little outside of its interval.
fn unit(x: f64) -> f32 {
    (x as f32).clamp(0.0, 1.0 - f32::EPSILON)
}

fn mean(rgb: Vec3) -> f64 {
    f64::from(rgb.element_sum()) / 3.0
}
