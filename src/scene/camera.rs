//! The pinhole camera.

use glam::Vec3;

use super::{DraftCamera, Units, normalise};
use crate::error::SceneError;

/// Which extent of the image the field of view spans.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FovAxis {
    /// The width.
    X,
    /// The height.
    #[default]
    Y,
    /// The smaller of the two.
    Smaller,
    /// The larger of the two.
    Larger,
}

/// A perspective camera. The image's x grows along `right`, its y down along `-up`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The pinhole, in normalised units.
    pub position: Vec3,
    /// Unit vector to the image's right.
    pub right: Vec3,
    /// Unit vector to the image's top.
    pub up: Vec3,
    /// Unit vector into the scene.
    pub forward: Vec3,
    /// Full angle of view along `fov_axis`, in degrees.
    pub fov: f64,
    /// The axis that `fov` spans.
    pub fov_axis: FovAxis,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

impl Camera {
    /// The largest width and height of an image, in pixels.
    pub const MAX_EXTENT: u32 = 65536;

    /// Tangents of half the angles of view along the width and the height.
    pub fn half_tangents(&self) -> [f32; 2] {
        let [width, height] = self.size.map(f64::from);
        let spanned = match self.fov_axis {
            FovAxis::X => width,
            FovAxis::Y => height,
            FovAxis::Smaller => width.min(height),
            FovAxis::Larger => width.max(height),
        };
        let tangent = (self.fov.to_radians() / 2.0).tan();
        [width, height].map(|extent| (tangent * extent / spanned) as f32)
    }
}

/// Checks the camera and brings it to normalised units.
pub fn finish(draft: &DraftCamera, units: &Units) -> Result<Camera, SceneError> {
    let fault = |what: &str| draft.origin.error(format!("camera: {what}"));
    if !(draft.fov > 0.0 && draft.fov < 180.0) {
        return Err(fault("fov must lie between 0 and 180 degrees, both excluded"));
    }
    if draft.size.iter().any(|extent| !(1..=Camera::MAX_EXTENT).contains(extent)) {
        return Err(fault("size must be 1 to 65536 pixels in width and in height"));
    }
    let forward = draft.direction.try_normalize().ok_or_else(|| {
        fault("it looks nowhere; give a direction other than 0, or a target apart from position")
    })?;
    let up = draft.up.try_normalize().ok_or_else(|| fault("up is 0; give another"))?;
    // Below this sine of their angle, rounding of the input decides where up is.
    let right = forward.cross(up);
    if right.length() < 1e-9 {
        return Err(fault("up is parallel to the direction of view; give another up"));
    }
    let right = right.normalize();
    let position = normalise::round(units.normalise(draft.position));
    if !position.is_finite() {
        return Err(fault("position is too far from the scene"));
    }
    Ok(Camera {
        position,
        right: normalise::round(right),
        up: normalise::round(right.cross(forward)),
        forward: normalise::round(forward),
        fov: draft.fov,
        fov_axis: draft.fov_axis,
        size: draft.size,
    })
}
