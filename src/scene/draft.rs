//! A scene being read, in the file's own units and f64.

use glam::{DMat4, DVec3};

use super::{FovAxis, Scene, Warning};
use crate::error::SceneError;

/// Triangles, materials, lights and camera as a file gives them. Loaders fill it;
/// [`Draft::finish`] makes the [`Scene`].
#[derive(Debug, Clone, Default)]
pub struct Draft {
    /// The file or `builtin:` name.
    pub name: String,
    /// Exposure of the PNG, in EV.
    pub exposure: f64,
    /// The camera, if there is one.
    pub camera: Option<DraftCamera>,
    /// Corners in the file's units, and the material's index.
    pub triangles: Vec<([DVec3; 3], u32)>,
    /// All materials met so far.
    pub materials: Vec<DraftMaterial>,
    /// Position, and intensity in W/sr.
    pub point_lights: Vec<(DVec3, DVec3)>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
}

/// A camera in the file's units.
#[derive(Debug, Clone, Copy)]
pub struct DraftCamera {
    /// The pinhole.
    pub position: DVec3,
    /// Viewing direction, of any length.
    pub direction: DVec3,
    /// A vector whose part across the direction points to the image's top.
    pub up: DVec3,
    /// Full angle of view in degrees.
    pub fov: f64,
    /// The axis `fov` spans.
    pub fov_axis: FovAxis,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

/// A diffuse, perhaps emitting material in f64.
#[derive(Debug, Clone, PartialEq)]
pub struct DraftMaterial {
    /// Its name in the files.
    pub name: String,
    /// Reflectance per channel.
    pub albedo: DVec3,
    /// Emitted radiance.
    pub emission: DVec3,
    /// Whether both sides emit.
    pub two_sided: bool,
}

impl Draft {
    /// Checks, recentres, scales and rounds the draft to a [`Scene`].
    ///
    /// # Errors
    /// No camera, no light, impossible values, or nothing to render.
    pub fn finish(self) -> Result<Scene, SceneError> {
        let _ = DMat4::IDENTITY;
        Err(SceneError::new(self.name, "not written"))
    }
}
