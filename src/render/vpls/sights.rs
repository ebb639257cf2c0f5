//! What the camera's side sees: places that visible points are lit from.

use glam::Vec3;
use rayon::prelude::*;

use crate::bvh::{Bvh, Ray};
use crate::render::materials::bsdf::{self, ShadingPoint, TransportMode};
use crate::render::materials::hit::{Facet, Surface};
use crate::render::plan::Plan;
use crate::sampling::{Sequence, hash};
use crate::scene::{Camera, Scene};

/// Keeps the random numbers apart from those of light paths.
const STREAM: u32 = 0x7369_6768;
/// The first dimension of what chooses between reflection and refraction; before it are two of the
/// pixel and two of the direction.
const SPECULAR_DIMENSION: u32 = 4;
/// Mirrors and glass between the camera and a visible point, at most.
const MOST_SPECULAR: u32 = 32;

/// A visible point, and a place that is seen from it in a direction drawn as its surface scatters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// The visible point.
    pub from: Facet,
    /// What it sees.
    pub to: Facet,
}

impl Sight {
    /// The geometry term between the two.
    pub fn geometry(&self) -> f32 {
        let between = self.to.position - self.from.position;
        let square = between.length_squared();
        let cosines =
            between.dot(self.from.normal).max(0.0) * (-between.dot(self.to.normal)).max(0.0);
        cosines / (square * square).max(f32::MIN_POSITIVE)
    }
}

/// Sights of the image's pixels, by so many rays of the camera, in their order.
pub fn sights(plan: &Plan, camera: &Camera, rays: u32, seed: u32) -> Vec<Sight> {
    let sequence = Sequence::new(hash(seed ^ STREAM));
    let (scene, bvh) = (&plan.scene, &plan.bvh);
    (0..rays).into_par_iter().filter_map(|ray| sight(scene, bvh, camera, &sequence, ray)).collect()
}

/// The sight of one of the camera's rays; none if that meets nothing, or if what the visible point
/// sees is nothing, or turns light away.
fn sight(
    scene: &Scene,
    bvh: &Bvh,
    camera: &Camera,
    sequence: &Sequence,
    ray: u32,
) -> Option<Sight> {
    let draw = |dimension| sequence.sample(ray, dimension);
    let mut direction = camera_direction(camera, [draw(0), draw(1)]);
    let mut ray = Ray { origin: camera.position, direction, limit: f32::MAX };
    for specular in 0..MOST_SPECULAR {
        let surface = Surface::of(scene, &bvh.closest(&ray)?, direction);
        let material = &scene.materials[surface.material as usize];
        let Surface { normal, front, albedo, .. } = surface;
        if !material.bsdf.is_specular() {
            let lobe_probability = bsdf::lobe_probability(material);
            let place = ShadingPoint { normal, albedo, bsdf: material.bsdf, lobe_probability };
            let scattered = place.scatter(-direction, [draw(2), draw(3)]);
            let next = surface.spawn_ray(scattered.direction);
            let seen = Surface::of(scene, &bvh.closest(&next)?, scattered.direction);
            let turns = scene.materials[seen.material as usize].bsdf.is_specular();
            return (!turns).then(|| Sight { from: surface.facet(), to: seen.facet() });
        }
        let u = draw(SPECULAR_DIMENSION + specular);
        let carried = TransportMode::Radiance;
        let sample = bsdf::sample_specular(&material.bsdf, normal, front, direction, u, carried)?;
        direction = sample.direction;
        ray = match sample.reflected {
            true => surface.spawn_ray(direction),
            false => surface.spawn_transmitted_ray(direction),
        };
    }
    None
}

/// The direction through a place of the image, in [0, 1]².
fn camera_direction(camera: &Camera, [x, y]: [f32; 2]) -> Vec3 {
    let [across, down] = camera.half_tangents();
    let side = (2.0 * x - 1.0) * across * camera.right;
    (camera.forward + side + (1.0 - 2.0 * y) * down * camera.up).normalize()
}
