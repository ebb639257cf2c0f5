//! Virtual point lights: light paths traced on the host (Keller, "Instant Radiosity", 1997).

use std::f32::consts::PI;
use std::ops::Range;

use glam::Vec3;
use rayon::prelude::*;

use super::starts::Starts;
use crate::bvh::{Bvh, Ray};
use crate::render::lights::{Lights, Start};
use crate::render::materials::bsdf::{self, ShadingPoint, TransportMode};
use crate::render::materials::hit::{Facet, Surface};
use crate::render::plan::Plan;
use crate::render::settings::{Bounces, Settings};
use crate::render::virtual_light::{GlossyLobe, VirtualLight};
use crate::sampling::Sequence;
use crate::scene::{Bsdf, Scene};

/// Russian roulette lets a path live with at most this probability.
const MOST_SURVIVAL: f32 = 0.95;
/// Dimensions of the sequence that the start of a path takes; a bounce takes three.
const START_DIMENSIONS: u32 = 5;
/// The first dimension of what chooses between reflection and refraction, in a block of its own.
const SPECULAR_DIMENSION: u32 = 1 << 20;
/// Mirrors and glass that a path meets at most.
const MOST_SPECULAR: u32 = 32;

/// A virtual point light: light that has arrived at a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vpl {
    /// Where it is.
    pub position: Vec3,
    /// Geometric normal of the side that the light reached.
    pub normal: Vec3,
    /// Unit direction in which the light arrived.
    pub incident: Vec3,
    /// Incident flux, in watts over the square of the scene's unit.
    pub flux: Vec3,
    /// Diffuse reflectance of the surface there.
    pub albedo: Vec3,
    /// Index of the material.
    pub material: u32,
    /// How many surfaces the light has reached, this one included.
    pub bounce: u32,
}

impl Vpl {
    /// Where it is, and the way it faces.
    pub fn facet(&self) -> Facet {
        Facet { position: self.position, normal: self.normal }
    }

    /// The light that the surface reflects.
    pub fn light(&self, scene: &Scene) -> VirtualLight {
        let gloss = match scene.materials[self.material as usize].bsdf {
            Bsdf::Phong { specular, shininess } => Some(GlossyLobe {
                material: self.material,
                specular: self.flux * specular / PI,
                shininess,
                mirrored: self.incident - 2.0 * self.incident.dot(self.normal) * self.normal,
            }),
            _ => None,
        };
        let intensity = self.flux * self.albedo / PI;
        VirtualLight { position: self.position, normal: self.normal, intensity, gloss }
    }
}

/// What light paths need of a scene.
#[derive(Debug, Clone, Copy)]
pub struct LightPaths<'a> {
    /// Materials.
    pub scene: &'a Scene,
    /// Surfaces.
    pub bvh: &'a Bvh,
    /// Where paths start.
    pub lights: &'a Lights,
    /// Paths that are launched.
    pub count: u32,
    /// Hits that deposit.
    pub bounces: Bounces,
    /// Of the sequence.
    pub seed: u32,
}

impl<'a> LightPaths<'a> {
    /// So many as the settings ask for.
    pub fn of(plan: &'a Plan, settings: &Settings, seed: u32) -> Self {
        let Plan { scene, bvh, lights, .. } = plan;
        let Settings { light_paths: count, bounces, .. } = *settings;
        Self { scene, bvh, lights, count, bounces, seed }
    }

    /// Traces all paths. The order is that of the paths and their bounces, for any number of
    /// threads.
    pub fn trace(&self) -> Vec<Vpl> {
        self.trace_from(None)
    }

    /// The same, of paths that start where it was learned that they count.
    pub fn trace_from(&self, starts: Option<&Starts>) -> Vec<Vpl> {
        let mut vpls = self.trace_some(0..self.count, starts);
        divide(&mut vpls, self.count);
        vpls
    }

    /// Some paths of the sequence, each with the flux of all: it is to be divided by their number.
    pub fn trace_some(&self, paths: Range<u32>, starts: Option<&Starts>) -> Vec<Vpl> {
        let sequence = Sequence::new(self.seed);
        paths
            .into_par_iter()
            .flat_map_iter(|path| self.trace_one(starts, &sequence, path))
            .collect()
    }

    fn trace_one(&self, starts: Option<&Starts>, sequence: &Sequence, path: u32) -> Vec<Vpl> {
        let mut vpls = Vec::new();
        let Some((mut ray, mut flux)) = self.start(starts, sequence, path) else { return vpls };
        let (mut bounce, mut specular) = (0u32, 0u32);
        while !matches!(self.bounces, Bounces::Finite(most) if bounce >= most) {
            let Some(hit) = self.bvh.closest(&ray) else { break };
            let surface = Surface::of(self.scene, &hit, ray.direction);
            let Surface { normal, front, albedo, material, .. } = surface;
            let of_surface = &self.scene.materials[material as usize];
            let bsdf = of_surface.bsdf;
            let incident = ray.direction;
            if bsdf.is_specular() {
                // Between facing mirrors it would go on for ever.
                let u = sequence.sample(path, SPECULAR_DIMENSION + specular);
                let sample =
                    bsdf::sample_specular(&bsdf, normal, front, incident, u, TransportMode::Flux);
                let Some(sample) = sample.filter(|_| specular < MOST_SPECULAR) else { break };
                flux *= sample.weight;
                ray = match sample.reflected {
                    true => surface.spawn_ray(sample.direction),
                    false => surface.spawn_transmitted_ray(sample.direction),
                };
                specular += 1;
                continue;
            }
            let lobe_probability = bsdf::lobe_probability(of_surface);
            let place = ShadingPoint { normal, albedo, bsdf, lobe_probability };
            // A black surface ends the path, and would be a light of no intensity.
            if (flux * (albedo + Vec3::splat(lobe_probability))).max_element() <= 0.0 {
                break;
            }
            let dimension = START_DIMENSIONS + 3 * bounce;
            bounce += 1;
            let position = surface.vpl_position();
            vpls.push(Vpl { position, normal, incident, flux, albedo, material, bounce });

            let draw = |i| sequence.sample(path, dimension + i);
            let scattered = place.scatter(-incident, [draw(0), draw(1)]);
            flux *= scattered.weight;
            if self.bounces == Bounces::Unlimited {
                let survival = scattered.weight.max_element().min(MOST_SURVIVAL);
                if draw(2) >= survival {
                    break;
                }
                flux /= survival;
            }
            ray = surface.spawn_ray(scattered.direction);
        }
        vpls
    }

    /// The first segment of a path and its flux.
    fn start(
        &self,
        starts: Option<&Starts>,
        sequence: &Sequence,
        path: u32,
    ) -> Option<(Ray, Vec3)> {
        let draw = |dimension| sequence.sample(path, dimension);
        let (scene, lights, place) = (self.scene, self.lights, [1, 2, 3, 4].map(draw));
        let Start { ray, flux } = match starts {
            Some(starts) => starts.start(scene, lights, draw(0), place)?,
            None => lights.start(scene, draw(0), place)?,
        };
        Some((ray, flux))
    }
}

/// Divides the light of all paths among so many.
pub fn divide(vpls: &mut [Vpl], paths: u32) {
    let share = 1.0 / paths as f32;
    vpls.iter_mut().for_each(|vpl| vpl.flux *= share);
}

/// The share of the flux that reaches surfaces which light paths still carry when a finite number
/// of bounces ends them: the tail of light that an image lacks. `None` where they are not ended.
pub fn truncated_fraction(vpls: &[Vpl], bounces: Bounces, scene: &Scene) -> Option<f64> {
    let Bounces::Finite(last) = bounces else { return None };
    let mean = |flux: Vec3| f64::from(flux.element_sum()) / 3.0;
    let of_bounce = |bounce: u32| vpls.iter().filter(move |vpl| vpl.bounce == bounce);
    let reached: f64 = of_bounce(1).map(|vpl| mean(vpl.flux)).sum();
    let specular = |vpl: &Vpl| match scene.materials[vpl.material as usize].bsdf {
        Bsdf::Phong { specular, .. } => specular,
        _ => Vec3::ZERO,
    };
    let carried: f64 =
        of_bounce(last).map(|vpl| mean(vpl.flux * (vpl.albedo + specular(vpl)))).sum();
    (reached > 0.0).then(|| carried / reached)
}
