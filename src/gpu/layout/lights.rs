//! Lights: sources, and virtual point lights.

use bytemuck::{Pod, Zeroable};

/// A virtual point light, 48 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct VplRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// Unused.
    pub pad0: f32,
    /// Unit normal of the side that it lights.
    pub normal: [f32; 3],
    /// Unused.
    /// Bound on the geometry term with it, see [`crate::render`]; unused where there is none.
    pub bound: f32,
    /// Intensity along the normal: exitant flux over π.
    pub intensity: [f32; 3],
    /// Mean of the channels of `intensity`.
    pub mean: f32,
}

/// A virtual point light with a Phong lobe, 80 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct GlossyVplRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// Exponent n of the lobe.
    pub shininess: f32,
    /// Unit normal of the side that it lights.
    pub normal: [f32; 3],
    /// The lobe at its peak over 1/π, (n + 2)/2; 0 without a lobe.
    pub peak: f32,
    /// Intensity along the normal of the diffuse part.
    pub intensity: [f32; 3],
    /// Mean of the channels of `intensity`.
    pub mean: f32,
    /// What the intensity would be if the lobe were diffuse.
    pub specular: [f32; 3],
    /// Mean of the channels of `specular`.
    pub specular_mean: f32,
    /// Unit direction of the lobe.
    pub mirrored: [f32; 3],
    /// As of [`VplRecord`].
    pub bound: f32,
}

/// A point light, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PointLightRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// The probability of all point lights before this one.
    pub before: f32,
    /// Radiant intensity, the same in all directions.
    pub intensity: [f32; 3],
    /// The probability of this light among the point lights.
    pub probability: f32,
}

/// A point light that shines into a cone, 64 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SpotLightRecord {
    /// Where it is.
    pub position: [f32; 3],
    /// The probability of all spot lights before this one.
    pub before: f32,
    /// Radiant intensity where it shines in full.
    pub intensity: [f32; 3],
    /// The probability of this light among the spot lights.
    pub probability: f32,
    /// Unit vector along the cone's axis.
    pub axis: [f32; 3],
    /// Cosine of the angle beyond which it does not shine.
    pub cos_outer: f32,
    /// How fast the ramp rises with the cosine from there.
    pub slope: f32,
    /// Unused.
    pub pad: [u32; 3],
}

/// A light infinitely far away, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct DirectionalLightRecord {
    /// Unit vector to where the light comes from.
    pub toward: [f32; 3],
    /// The probability of all directional lights before this one.
    pub before: f32,
    /// Irradiance of a surface across it.
    pub irradiance: [f32; 3],
    /// The probability of this light among the directional lights.
    pub probability: f32,
}

/// A light without extent of any kind, 48 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct DeltaLightRecord {
    /// Where it is, or the unit vector to where the light comes from.
    pub place: [f32; 3],
    /// Whether it is infinitely far away.
    pub is_far: u32,
    /// Radiant intensity where it shines in full; if it is far away, irradiance of a surface across.
    pub intensity: [f32; 3],
    /// How fast a spot's ramp rises with the cosine from `cos_outer`.
    pub slope: f32,
    /// Unit vector along a spot's axis; 0 without one.
    pub axis: [f32; 3],
    /// Cosine of the angle beyond which a spot does not shine.
    pub cos_outer: f32,
}

/// An emitting triangle, 80 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct AreaLightRecord {
    /// First corner.
    pub corner: [f32; 3],
    /// The probability of all lights before this one.
    pub before: f32,
    /// Second corner minus the first.
    pub edge1: [f32; 3],
    /// The probability of this light.
    pub probability: f32,
    /// Third corner minus the first.
    pub edge2: [f32; 3],
    /// Whether both sides emit.
    pub two_sided: u32,
    /// Unit normal of the emitting side.
    pub normal: [f32; 3],
    /// The area.
    pub area: f32,
    /// Emitted radiance.
    pub radiance: [f32; 3],
    /// Unused.
    pub pad: f32,
}

/// An emitting sphere, 48 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SphereLightRecord {
    /// The centre.
    pub center: [f32; 3],
    /// The radius.
    pub radius: f32,
    /// Emitted radiance.
    pub radiance: [f32; 3],
    /// Whether it emits inwards, too.
    pub two_sided: u32,
    /// The probability of all emitting spheres before this one.
    pub before: f32,
    /// The probability of this one.
    pub probability: f32,
    /// Unused.
    pub pad: [u32; 2],
}

/// A stratum of the lights that have some extent: a rectangle in the square from which the lights of a
/// kind are drawn, 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct LightStratumRecord {
    /// Its corner.
    pub low: [f32; 2],
    /// Its extent.
    pub extent: [f32; 2],
    /// Of the lights: 0 emitting triangles, 1 emitting spheres, 2 the environment, 3 an even one by
    /// the cosine at the point.
    pub kind: u32,
    /// Unused.
    pub pad: [u32; 3],
}
