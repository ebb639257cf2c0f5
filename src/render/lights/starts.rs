//! Where light paths start: at a light drawn by power, or at one that is chosen.

use glam::Vec3;

use super::{Bounds, FarLight, LightKind, Lights, Start, area, directional, point, sphere};
use crate::scene::Scene;

/// The order in which light paths choose among kinds. Area lights are first, as always: what a seed
/// gives is to stay.
const ORDER: [LightKind; 6] = [
    LightKind::Area,
    LightKind::Sphere,
    LightKind::Point,
    LightKind::Spot,
    LightKind::Directional,
    LightKind::Environment,
];
/// So many of them are not infinitely far away.
const NEAR: usize = 4;

impl Lights {
    /// The start of a light path, from a light drawn by power with `choice`, and at a place and in
    /// a direction drawn with `u`; none if no light has any power.
    pub fn start(&self, scene: &Scene, choice: f32, u: [f32; 4]) -> Option<Start> {
        self.start_among(&ORDER, scene, choice, u)
    }

    /// The start of a light path of the lights that are not infinitely far away, as [`Self::start`]
    /// gives that of all.
    pub fn start_near(&self, scene: &Scene, choice: f32, u: [f32; 4]) -> Option<Start> {
        self.start_among(&ORDER[..NEAR], scene, choice, u)
    }

    /// Flux of the lights that are not infinitely far away, mean of the channels.
    pub fn near_power(&self) -> f64 {
        ORDER[..NEAR].iter().map(|&kind| self.power(kind)).sum()
    }

    /// From a light of these kinds.
    fn start_among(
        &self,
        kinds: &[LightKind],
        scene: &Scene,
        choice: f32,
        u: [f32; 4],
    ) -> Option<Start> {
        let lit = || kinds.iter().copied().filter(|&kind| self.power(kind) > 0.0);
        let total: f64 = lit().map(|kind| self.power(kind)).sum();
        let mut target = f64::from(choice) * total;
        let last = lit().next_back()?;
        for kind in lit() {
            let power = self.power(kind);
            if target < power || kind == last {
                let at = (target / power).min(1.0);
                let (start, probability) = self.start_of(scene, kind, at, u)?;
                let probability = (power / total * f64::from(probability)) as f32;
                return Some(Start { flux: start.flux / probability, ..start });
            }
            target -= power;
        }
        None
    }

    /// From the light of a kind whose interval of probability holds `at`, and its probability.
    fn start_of(
        &self,
        scene: &Scene,
        kind: LightKind,
        at: f64,
        u: [f32; 4],
    ) -> Option<(Start, f32)> {
        Some(match kind {
            LightKind::Area => {
                let (index, probability, rest) = self.area.index_at(at)?;
                let light = &self.area.records[index];
                (area::start(scene, light, self.emitters[index], rest, u), probability)
            }
            LightKind::Sphere => {
                let (light, probability, rest) = self.sphere.at(at)?;
                (sphere::start(light, rest, u), probability)
            }
            LightKind::Point => {
                let (light, probability, _) = self.point.at(at)?;
                (point::start_of_point(light, u), probability)
            }
            LightKind::Spot => {
                let (light, probability, _) = self.spot.at(at)?;
                (point::start_of_spot(light, u), probability)
            }
            LightKind::Directional => {
                let (light, probability, _) = self.directional.at(at)?;
                (directional::start(light, &self.bounds, u), probability)
            }
            LightKind::Environment => {
                let (light, environment) =
                    (self.environment.as_ref()?, scene.environment.as_ref()?);
                (light.start(environment, &self.bounds, u), 1.0)
            }
        })
    }
}

impl Lights {
    /// All that have any power, with what goes through an area across a direction: irradiance, of the
    /// environment integrated over all directions; mean of the channels.
    pub fn far(&self) -> Vec<(FarLight, f64)> {
        let records = self.directional.records.iter().enumerate();
        let one = |(i, record): (usize, _)| {
            (FarLight::Directional(i as u32), directional::irradiance(record))
        };
        let sky = self.environment.iter().map(|sky| (FarLight::Environment, sky.radiance_integral));
        records.map(one).chain(sky).filter(|&(_, irradiance)| irradiance > 0.0).collect()
    }

    /// The area of the disc through which far lights shine.
    pub fn far_area(&self) -> f64 {
        self.bounds.area()
    }

    /// A sphere about a place of the scene that holds all of it.
    pub fn bounds_around(&self, center: Vec3) -> Bounds {
        self.bounds.around(center)
    }

    /// The start of a light path from a far light, uniform on the disc across a sphere that holds the
    /// scene: its place there is drawn with the first two of `u`, its direction, if there is more than
    /// one, with the others; none if there is no such light.
    pub fn start_far(
        &self,
        scene: &Scene,
        light: FarLight,
        bounds: &Bounds,
        u: [f32; 4],
    ) -> Option<Start> {
        match light {
            FarLight::Directional(i) => {
                Some(directional::start(self.directional.records.get(i as usize)?, bounds, u))
            }
            FarLight::Environment => {
                let (light, environment) =
                    (self.environment.as_ref()?, scene.environment.as_ref()?);
                Some(light.start(environment, bounds, u))
            }
        }
    }
}
