//! Where light paths from the sky and the sun start: through the disc across the whole scene, and mostly
//! where the camera's side found that such light arrives at what visible points see.

mod arrivals;

use glam::Vec3;

use super::warp::Warp;
use crate::bvh::Bvh;
use crate::render::lights::{Bounds, FarLight, Lights, Start};
use crate::render::materials::hit::Facet;
use crate::scene::Scene;
use arrivals::Arrivals;

/// This share of the paths is shared out among the lights by power, the rest by what arrives.
const BY_POWER: f64 = 0.2;

/// A density of starts of light paths, positive wherever one carries light.
#[derive(Debug)]
pub struct Starts {
    /// A sphere that holds the scene, about the middle of the places that are lit: boxes of the disc
    /// across it are small there.
    bounds: Bounds,
    /// Of paths that start at a lamp.
    near: f64,
    far: Vec<LearnedLight>,
}

#[derive(Debug)]
struct LearnedLight {
    light: FarLight,
    probability: f64,
    warp: Warp,
}

impl Starts {
    /// Learned from places that visible points see, with their normals; none if no far light arrives
    /// there.
    pub fn learned(
        scene: &Scene,
        bvh: &Bvh,
        lights: &Lights,
        seen: &[Facet],
        seed: u32,
    ) -> Option<Self> {
        let far = lights.far();
        if far.is_empty() || seen.is_empty() {
            return None;
        }
        let bounds = lights.bounds_around(middle(seen));
        let Arrivals { places, irradiance, near } =
            arrivals::of(scene, bvh, lights, &far, &bounds, seen, seed)?;
        let near_power = lights.near_power();
        let area = lights.far_area();
        let power = near_power + far.iter().map(|light| light.1 * area).sum::<f64>();
        let arrives = near + irradiance.iter().sum::<f64>();
        let probability = |own_power: f64, own: f64| {
            let learned = if arrives > 0.0 { own / arrives } else { own_power / power };
            BY_POWER * own_power / power + (1.0 - BY_POWER) * learned
        };
        let of_far = far.iter().zip(&irradiance).zip(places);
        let far = of_far.map(|((&(light, own), &arrived), places)| LearnedLight {
            light,
            probability: probability(own * area, arrived),
            warp: Warp::of(places),
        });
        Some(Self { bounds, far: far.collect(), near: probability(near_power, near) })
    }

    /// The start of a light path, as [`Lights::start`] gives it: the mean over random numbers of what
    /// paths carry is the same.
    pub fn start(&self, scene: &Scene, lights: &Lights, choice: f32, u: [f32; 4]) -> Option<Start> {
        let mut rest = f64::from(choice);
        if rest < self.near || self.far.is_empty() {
            let start = lights.start_near(scene, (rest / self.near) as f32, u)?;
            return Some(Start { flux: start.flux / self.near as f32, ..start });
        }
        rest -= self.near;
        let light = self.far.iter().find(|light| {
            rest -= light.probability;
            rest < 0.0
        });
        let light = light.or(self.far.last())?;
        let (place, density) = light.warp.at(u);
        let start = lights.start_far(scene, light.light, &self.bounds, place)?;
        Some(Start { flux: start.flux / (light.probability * density) as f32, ..start })
    }
}

/// The median of each coordinate: of a view through a window, the middle of the room.
fn middle(seen: &[Facet]) -> Vec3 {
    let median = |axis: usize| {
        let mut all: Vec<f32> = seen.iter().map(|place| place.position[axis]).collect();
        let middle = all.len() / 2;
        *all.select_nth_unstable_by(middle, f32::total_cmp).1
    };
    Vec3::new(median(0), median(1), median(2))
}
