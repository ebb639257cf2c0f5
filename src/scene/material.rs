//! What surfaces are made of.

use glam::Vec3;

/// How a surface reflects beside its diffuse part.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Bsdf {
    /// Not at all: the BRDF is ρ / π.
    #[default]
    Diffuse,
    /// Modified Phong (Lafortune and Willems, "Using the Modified Phong Reflectance Model for
    /// Physically Based Rendering", 1994): the BRDF is ρ / π + k_s (n + 2) / 2π cosⁿ α, with α
    /// the angle from the mirrored direction.
    Phong {
        /// k_s per channel; with the albedo at most 1.
        specular: Vec3,
        /// n.
        shininess: f32,
    },
    /// An ideal mirror.
    Mirror {
        /// Reflectance per channel.
        specular: Vec3,
    },
    /// A smooth dielectric, the inside behind its normal.
    Glass {
        /// What of the light goes on, per channel, reflected or refracted.
        specular: Vec3,
        /// Index of refraction of the inside over that of the outside.
        ior: f32,
    },
}

impl Bsdf {
    /// Whether light is reflected or refracted into single directions only.
    pub fn is_specular(&self) -> bool {
        matches!(self, Self::Mirror { .. } | Self::Glass { .. })
    }
}

/// A surface, lit on both sides, that may emit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Material {
    /// The name it has in the files.
    pub name: String,
    /// Diffuse reflectance ρ per channel, in [0, 1]; the BRDF is ρ / π, and what its BSDF adds.
    pub albedo: Vec3,
    /// Index into [`Scene::textures`](super::Scene::textures) of what the albedo is multiplied by.
    pub texture: Option<u32>,
    /// Index into [`Scene::textures`](super::Scene::textures) of the texture where whose alpha is
    /// below one half there is no surface.
    pub cutout: Option<u32>,
    /// How it reflects beside its diffuse part.
    pub bsdf: Bsdf,
    /// Emitted radiance [W sr⁻¹ m⁻²].
    pub emission: Vec3,
    /// Index into [`Scene::textures`](super::Scene::textures) of what the emission is multiplied by.
    pub emission_texture: Option<u32>,
    /// Whether both sides emit, or only that of the geometric normal.
    pub two_sided: bool,
}

impl Material {
    /// Whether its triangles and spheres are area lights.
    pub fn emits(&self) -> bool {
        self.emission.max_element() > 0.0
    }

    /// Indices of its textures.
    pub fn textures(&self) -> impl Iterator<Item = u32> + use<> {
        [self.texture, self.cutout, self.emission_texture].into_iter().flatten()
    }
}
