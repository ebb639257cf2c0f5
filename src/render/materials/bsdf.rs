//! BSDFs on the host: the twin of `shaders/materials/scatter_phong.wgsl` and
//! `shaders/materials/specular_sample.wgsl`.

use std::f32::consts::PI;

use glam::Vec3;

use crate::gpu::BsdfRecord;
use crate::sampling::{about, cosine_hemisphere};
use crate::scene::{Bsdf, Material, Scene};

/// Where light is scattered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShadingPoint {
    /// Unit normal of the side that is lit and seen.
    pub normal: Vec3,
    /// Diffuse reflectance.
    pub albedo: Vec3,
    /// What there is beside it.
    pub bsdf: Bsdf,
    /// The probability that a direction is drawn from a Phong lobe, see [`lobe_probability`].
    pub lobe_probability: f32,
}

/// A direction in which light goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BsdfSample {
    /// Unit vector.
    pub direction: Vec3,
    /// BRDF times cosine over the density; 0 below the surface.
    pub weight: Vec3,
    /// The density by solid angle.
    pub density: f32,
}

impl ShadingPoint {
    /// The BRDF between unit directions away from the surface, in 1/sr: modified Phong (Lafortune
    /// and Willems 1994), of which the diffuse part alone is Lambert's.
    pub fn brdf(&self, view: Vec3, toward: Vec3) -> Vec3 {
        let diffuse = self.albedo / PI;
        match self.bsdf {
            Bsdf::Phong { specular, shininess } => {
                let lobe = lobe(self.mirrored(view), toward, shininess);
                diffuse + specular * ((shininess + 2.0) / (2.0 * PI) * lobe)
            }
            _ => diffuse,
        }
    }

    /// The density with which [`ShadingPoint::scatter`] draws a direction, by solid angle.
    pub fn density(&self, view: Vec3, toward: Vec3) -> f32 {
        let diffuse = self.normal.dot(toward).max(0.0) / PI;
        match self.bsdf {
            Bsdf::Phong { shininess, .. } => {
                let lobe = lobe(self.mirrored(view), toward, shininess);
                let glossy = (shininess + 1.0) / (2.0 * PI) * lobe;
                (1.0 - self.lobe_probability) * diffuse + self.lobe_probability * glossy
            }
            _ => diffuse,
        }
    }

    /// Draws a direction by the cosine about the normal, or, as often as `lobe_probability` says, by cosⁿ
    /// about the mirrored direction.
    pub fn scatter(&self, view: Vec3, u: [f32; 2]) -> BsdfSample {
        let Bsdf::Phong { shininess, .. } = self.bsdf else {
            let direction = cosine_hemisphere(self.normal, u);
            let density = self.density(view, direction);
            return BsdfSample { direction, weight: self.albedo, density };
        };
        let glossy = u[0] < self.lobe_probability;
        // What is left of the number that has chosen is uniform again.
        let (before, share) = if glossy {
            (0.0, self.lobe_probability)
        } else {
            (self.lobe_probability, 1.0 - self.lobe_probability)
        };
        let rest = [((u[0] - before) / share).clamp(0.0, 1.0), u[1]];
        let direction = match glossy {
            true => {
                let cosine = libm::powf(1.0 - rest[0], 1.0 / (shininess + 1.0));
                about(self.mirrored(view), cosine, rest[1])
            }
            false => cosine_hemisphere(self.normal, rest),
        };
        let (cosine, density) = (self.normal.dot(direction), self.density(view, direction));
        let weight = match cosine > 0.0 && density > 0.0 {
            true => self.brdf(view, direction) * (cosine / density),
            false => Vec3::ZERO,
        };
        BsdfSample { direction, weight, density }
    }

    /// The mirrored direction.
    pub fn mirrored(&self, direction: Vec3) -> Vec3 {
        2.0 * direction.dot(self.normal) * self.normal - direction
    }
}

/// cosⁿ of the angle between unit directions, 0 beyond a right angle.
pub fn lobe(one: Vec3, other: Vec3, shininess: f32) -> f32 {
    let cosine = one.dot(other);
    if cosine > 0.0 { libm::powf(cosine, shininess) } else { 0.0 }
}

/// With which probability a direction is drawn from a material's Phong lobe: the lobe's share of
/// what it reflects.
pub fn lobe_probability(material: &Material) -> f32 {
    match material.bsdf {
        Bsdf::Phong { specular, .. } if specular.max_element() > 0.0 => {
            let (diffuse, lobe) = (material.albedo.element_sum(), specular.element_sum());
            lobe / (diffuse + lobe)
        }
        _ => 0.0,
    }
}

/// What is carried along a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TransportMode {
    /// Radiance, from where the path goes to where it came from.
    Radiance,
    /// Flux, the way of the path.
    Flux,
}

/// The way on at a mirror or glass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpecularSample {
    /// Unit vector.
    pub direction: Vec3,
    /// What the path carries on.
    pub weight: Vec3,
    /// Whether it stays on the side of the normal.
    pub reflected: bool,
}

/// Where light that goes along `direction` goes on at a mirror or glass, of which `front` is lit
/// with the normal `normal`. Glass reflects if `u` is below Fresnel's reflectance, else refracts.
pub fn sample_specular(
    bsdf: &Bsdf,
    normal: Vec3,
    front: bool,
    direction: Vec3,
    u: f32,
    carried: TransportMode,
) -> Option<SpecularSample> {
    let cosine = -direction.dot(normal);
    let mirrored = (direction + 2.0 * cosine * normal).normalize();
    let (specular, ior) = match *bsdf {
        Bsdf::Mirror { specular } => {
            return Some(SpecularSample { direction: mirrored, weight: specular, reflected: true });
        }
        Bsdf::Glass { specular, ior } => (specular, ior),
        Bsdf::Diffuse | Bsdf::Phong { .. } => return None,
    };
    let eta = if front { ior } else { 1.0 / ior };
    if u < fresnel(cosine, eta) {
        return Some(SpecularSample { direction: mirrored, weight: specular, reflected: true });
    }
    let beyond = (1.0 - (1.0 - cosine * cosine) / (eta * eta)).max(0.0).sqrt();
    let direction = (direction / eta + (cosine / eta - beyond) * normal).normalize();
    // Radiance is denser where light is slower (Veach, "Robust Monte Carlo Methods", 5.2).
    let density = if carried == TransportMode::Radiance { eta * eta } else { 1.0 };
    Some(SpecularSample { direction, weight: specular / density, reflected: false })
}

/// Fresnel's reflectance of unpolarised light under a cosine; `eta` is the index of refraction of
/// what is beyond over that of what is before.
pub fn fresnel(cosine: f32, eta: f32) -> f32 {
    let square = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
    if square <= 0.0 {
        // Total reflection.
        return 1.0;
    }
    let beyond = square.sqrt();
    let across = (cosine - eta * beyond) / (cosine + eta * beyond);
    let along = (eta * cosine - beyond) / (eta * cosine + beyond);
    0.5 * (across * across + along * along)
}

/// The bsdfs of a scene's materials, for the device.
pub fn bsdfs(scene: &Scene) -> Vec<BsdfRecord> {
    scene.materials.iter().map(bsdf_record).collect()
}

/// The BSDF of a material, for the device.
pub fn bsdf_record(material: &Material) -> BsdfRecord {
    let (kind, specular, parameter) = match material.bsdf {
        Bsdf::Diffuse => (0, Vec3::ZERO, 0.0),
        Bsdf::Phong { specular, shininess } => (1, specular, shininess),
        Bsdf::Mirror { specular } => (2, specular, 0.0),
        Bsdf::Glass { specular, ior } => (3, specular, ior),
    };
    let (specular, lobe_probability) = (specular.to_array(), lobe_probability(material));
    BsdfRecord { specular, kind, parameter, lobe_probability, pad: [0; 2] }
}
