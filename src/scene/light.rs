//! Lights without extent: point and spot lights, and directional ones.

use glam::Vec3;

/// A light without extent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLight {
    /// Where it is.
    pub position: Vec3,
    /// Radiant intensity, in W sr⁻¹ over [`Units::scale`](super::Units::scale) squared, so that
    /// intensity over normalised distance squared is irradiance.
    pub intensity: Vec3,
    /// Of a spot light, where it shines.
    pub cone: Option<Cone>,
}

/// The cone of a spot light: its intensity is multiplied by the square of a ramp in the cosine
/// of the angle to its axis, which is 1 up to the inner angle, and 0 from the outer one on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// Unit vector along its axis, away from the light.
    pub axis: Vec3,
    /// Cosine of the angle within which it shines in full.
    pub cos_inner: f32,
    /// Cosine of the angle beyond which it doesn't; less than `cos_inner`.
    pub cos_outer: f32,
}

/// A light infinitely far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionalLight {
    /// Unit vector along which its light goes.
    pub direction: Vec3,
    /// Irradiance of a surface across it [W m⁻²].
    pub irradiance: Vec3,
}
