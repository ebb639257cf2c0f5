//! Where light from infinitely far away arrives, at places that visible points see and some bounces on.

use glam::Vec3;
use rayon::prelude::*;

use crate::bvh::{Bvh, Ray};
use crate::render::lights::{Bounds, FarLight, Lights, Start};
use crate::render::materials::hit::{Facet, Surface};
use crate::render::vpls::density::Density;
use crate::render::vpls::warp::Place;
use crate::sampling::{SURFACE_OFFSET, Sequence, cosine_hemisphere, hash};
use crate::scene::{Bsdf, Scene};

/// Of the sequences.
const STREAM: u32 = 0x7374_6172;
/// Places that are asked at a time.
const BATCH: usize = 8192;
/// Arrivals that suffice.
const ENOUGH: usize = 8192;
/// Surfaces on the way from a light to what is seen, that one included.
const BOUNCES: u32 = 3;
/// Dimensions of the sequence that each takes.
const BOUNCE_DIMENSIONS: u32 = 7;
/// What a surface is taken to reflect.
const ALBEDO: f64 = 0.5;
/// Panes of glass that light passes at most.
const MOST_PANES: u32 = 16;
/// Paths that are to tell what lamps give to places that are seen.
const NEAR_PATHS: u32 = 4096;
/// Places that tell how densely they are seen.
const NEIGHBOURS: usize = 16;

/// What arrives.
#[derive(Debug)]
pub struct Arrivals {
    /// For each far light, the random numbers of starts that arrive, and how much they give.
    pub places: Vec<Vec<Place>>,
    /// The mean irradiance of each on places that are seen, mean of the channels.
    pub irradiance: Vec<f64>,
    /// That of all lamps.
    pub near: f64,
}

/// One way on which light arrives.
struct Arrival {
    light: usize,
    place: Place,
    bounce: u32,
}

/// What traces the ways back.
struct Search<'a> {
    scene: &'a Scene,
    bvh: &'a Bvh,
    lights: &'a Lights,
    far: &'a [(FarLight, f64)],
    irradiance: f64,
    bounds: &'a Bounds,
    sequence: Sequence,
    panes: bool,
}

/// Asks so many places that enough arrives, or all; none if nothing does.
pub fn of(
    scene: &Scene,
    bvh: &Bvh,
    lights: &Lights,
    far: &[(FarLight, f64)],
    bounds: &Bounds,
    seen: &[Facet],
    seed: u32,
) -> Option<Arrivals> {
    let glass = |material: &crate::scene::Material| matches!(material.bsdf, Bsdf::Glass { .. });
    let search = Search {
        scene,
        bvh,
        lights,
        far,
        irradiance: far.iter().map(|light| light.1).sum(),
        bounds,
        sequence: Sequence::new(hash(seed ^ STREAM)),
        panes: scene.materials.iter().any(glass),
    };
    let mut found: Vec<Arrival> = Vec::new();
    let mut asked = 0;
    for batch in seen.chunks(BATCH) {
        let of = |(i, &place): (usize, _)| search.from(asked as u32 + i as u32, place);
        let more: Vec<Vec<Arrival>> = batch.par_iter().enumerate().map(of).collect();
        found.extend(more.into_iter().flatten());
        asked += batch.len();
        if found.len() >= ENOUGH {
            break;
        }
    }
    if found.is_empty() {
        return None;
    }
    let mut places = vec![Vec::new(); far.len()];
    let mut irradiance = vec![0.0; far.len()];
    for Arrival { light, place, bounce } in found {
        places[light].push(place);
        if bounce == 0 {
            irradiance[light] += place.1 / asked as f64;
        }
    }
    Some(Arrivals { places, irradiance, near: search.near(seen) })
}

impl Search<'_> {
    /// The ways on which light arrives at a place.
    fn from(&self, index: u32, place: Facet) -> Vec<Arrival> {
        let Facet { mut position, mut normal } = place;
        let mut arrivals = Vec::new();
        let mut weight = 1.0;
        for bounce in 0..BOUNCES {
            let draw = |d| self.sequence.sample(index, BOUNCE_DIMENSIONS * bounce + d);
            let origin = position + SURFACE_OFFSET * normal;
            if let Some((light, (place, given))) =
                self.arrival(origin, normal, [0, 1, 2, 3, 4].map(draw))
            {
                arrivals.push(Arrival { light, place: (place, weight * given), bounce });
            }
            let direction = cosine_hemisphere(normal, [draw(5), draw(6)]);
            let ray = Ray { origin, direction, limit: f32::MAX };
            let Some(hit) = self.bvh.closest(&ray) else { break };
            let surface = Surface::of(self.scene, &hit, direction);
            if self.scene.materials[surface.material as usize].bsdf.is_specular() {
                break;
            }
            (position, normal) = (surface.vpl_position(), surface.normal);
            weight *= ALBEDO;
        }
        arrivals
    }

    /// Far light that arrives from a direction that is drawn, with the random numbers of its start.
    fn arrival(&self, origin: Vec3, normal: Vec3, u: [f32; 5]) -> Option<(usize, Place)> {
        let [choice, a, b, u, v] = u;
        let mut rest = f64::from(choice) * self.irradiance;
        let light = self.far.iter().position(|(_, own)| {
            rest -= own;
            rest < 0.0
        });
        let light = light.unwrap_or(self.far.len() - 1);
        let (far, own) = self.far[light];
        let (probability, area) = (own / self.irradiance, self.bounds.area());
        let Start { ray, flux } =
            self.lights.start_far(self.scene, far, self.bounds, [a, b, u, v])?;
        let toward = -ray.direction;
        let cosine = toward.dot(normal);
        if cosine <= 0.0 || !self.escapes(Ray { origin, direction: toward, limit: f32::MAX }) {
            return None;
        }
        let [a, b] = self.bounds.place_across(ray.direction, origin);
        let given = f64::from(cosine) * f64::from(flux.element_sum()) / (3.0 * area * probability);
        Some((light, ([a, b, u, v], given)))
    }

    /// Whether nothing but glass is on the way; glass is taken for thin.
    fn escapes(&self, mut ray: Ray) -> bool {
        if !self.panes {
            return !self.bvh.occluded(&ray);
        }
        for _ in 0..MOST_PANES {
            let Some(hit) = self.bvh.closest(&ray) else { return true };
            if !matches!(self.scene.materials[hit.material as usize].bsdf, Bsdf::Glass { .. }) {
                return false;
            }
            let surface = Surface::of(self.scene, &hit, ray.direction);
            ray = surface.spawn_transmitted_ray(ray.direction);
        }
        false
    }

    /// The mean irradiance from lamps on places that are seen: by the density of such places where
    /// paths from lamps arrive.
    fn near(&self, seen: &[Facet]) -> f64 {
        if self.lights.near_power() <= 0.0 {
            return 0.0;
        }
        let places = Density::of(seen.iter().map(|&place| (place, 1.0)));
        let sequence = Sequence::new(hash(hash(STREAM) ^ self.sequence.sample(0, 0).to_bits()));
        let given = |i: u32| {
            let draw = |d| sequence.sample(i, d);
            let Start { ray, flux } =
                self.lights.start_near(self.scene, draw(0), [1, 2, 3, 4].map(draw))?;
            let hit = self.bvh.closest(&ray)?;
            let surface = Surface::of(self.scene, &hit, ray.direction);
            let density = places.at(surface.facet(), NEIGHBOURS);
            Some(density * f64::from(flux.element_sum()) / 3.0)
        };
        let given: Vec<f64> = (0..NEAR_PATHS).into_par_iter().filter_map(given).collect();
        given.iter().sum::<f64>() / (f64::from(NEAR_PATHS) * seen.len() as f64)
    }
}
