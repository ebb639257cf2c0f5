//! What visible points gather: VPLs, clusters of them, or places on light sources.

use glam::Vec3;

/// A light of a point and a side: what is gathered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualLight {
    /// Where it is.
    pub position: Vec3,
    /// Unit normal of the side that it lights.
    pub normal: Vec3,
    /// Intensity along the normal of its diffuse part, per channel: exitant flux over π.
    pub intensity: Vec3,
    /// What a glossy surface adds.
    pub gloss: Option<GlossyLobe>,
}

/// The Phong lobe of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlossyLobe {
    /// Index of the material.
    pub material: u32,
    /// What the intensity would be if the lobe were diffuse: flux times k_s over π.
    pub specular: Vec3,
    /// Exponent n.
    pub shininess: f32,
    /// Unit direction of the lobe, in which the surface mirrors the light that it got.
    pub mirrored: Vec3,
}

impl VirtualLight {
    /// A diffuse light.
    pub fn diffuse(position: Vec3, normal: Vec3, intensity: Vec3) -> Self {
        Self { position, normal, intensity, gloss: None }
    }
}
