//! The pinhole camera.

use glam::Vec3;

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
