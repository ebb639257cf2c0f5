//! A scene being read, in the file's own units and f64.

use std::path::PathBuf;

use glam::DVec3;

use super::{FovAxis, Material, Scene, Warning, camera, normalise};
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

/// Where in the input something was said.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Origin {
    /// The file or `builtin:` name.
    pub file: PathBuf,
    /// The line in it, counted from 1.
    pub line: Option<usize>,
}

impl Origin {
    /// A whole file.
    pub fn file(file: impl Into<PathBuf>) -> Self {
        Self { file: file.into(), line: None }
    }

    /// A line of a file.
    pub fn line(file: impl Into<PathBuf>, line: usize) -> Self {
        Self { file: file.into(), line: Some(line) }
    }

    /// An error at this place.
    pub fn error(&self, what: impl Into<String>) -> SceneError {
        match self.line {
            Some(line) => SceneError::at(&self.file, line, what),
            None => SceneError::new(&self.file, what),
        }
    }
}

/// A camera in the file's units.
#[derive(Debug, Clone)]
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
    /// Where the camera was described.
    pub origin: Origin,
}

/// A diffuse, perhaps emitting material in f64.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DraftMaterial {
    /// Its name in the files.
    pub name: String,
    /// Reflectance per channel.
    pub albedo: DVec3,
    /// Emitted radiance.
    pub emission: DVec3,
    /// Whether both sides emit.
    pub two_sided: bool,
    /// Where it was described.
    pub origin: Origin,
}

impl Draft {
    /// An empty draft of this name.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }

    /// Adds a material and returns its index.
    ///
    /// # Errors
    /// There are 2³² of them.
    pub fn add_material(&mut self, material: DraftMaterial) -> Result<u32, SceneError> {
        let index = u32::try_from(self.materials.len())
            .map_err(|_| SceneError::new(&self.name, "too many materials"))?;
        self.materials.push(material);
        Ok(index)
    }

    /// Checks, recentres, scales and rounds the draft to a [`Scene`].
    ///
    /// # Errors
    /// No camera, no light, impossible values, or nothing to render.
    pub fn finish(mut self) -> Result<Scene, SceneError> {
        let origin = Origin::file(&self.name);
        let materials: Vec<Material> =
            self.materials.iter().map(DraftMaterial::finish).collect::<Result<_, _>>()?;
        if !(-100.0..=100.0).contains(&self.exposure) {
            return Err(origin.error("exposure is not within -100 and 100 EV"));
        }
        let draft_camera = self.camera.take().ok_or_else(|| {
            origin.error("no camera: add a [camera] table with position, target and fov")
        })?;
        let mesh = normalise::triangles(&origin, &self.triangles, &materials)?;
        let point_lights = normalise::point_lights(&origin, &self.point_lights, &mesh.units)?;
        let mut warnings = self.warnings;
        warnings.extend(mesh.warnings);
        let scene = Scene {
            name: self.name,
            camera: camera::finish(&draft_camera, &mesh.units)?,
            exposure: self.exposure as f32,
            triangles: mesh.triangles,
            materials,
            point_lights,
            units: mesh.units,
            dropped_triangles: mesh.dropped,
            warnings,
        };
        let lit = scene.point_lights.iter().any(|light| light.intensity.max_element() > 0.0)
            || scene.emitters().next().is_some();
        if !lit {
            return Err(origin.error(
                "no light: add a [[light]], or a material with an emission, that is not black",
            ));
        }
        Ok(scene)
    }
}

impl DraftMaterial {
    /// Checks and rounds it.
    fn finish(&self) -> Result<Material, SceneError> {
        let fault = |what: &str, value: DVec3, range: &str| {
            let DVec3 { x, y, z } = value;
            let name = &self.name;
            self.origin.error(format!("material `{name}`: {what} [{x}, {y}, {z}] is not {range}"))
        };
        if !self.albedo.to_array().iter().all(|a| (0.0..=1.0).contains(a)) {
            return Err(fault("albedo", self.albedo, "within 0 and 1"));
        }
        if !is_power(self.emission) {
            return Err(fault("emission", self.emission, "a finite radiance of 0 or more"));
        }
        Ok(Material {
            name: self.name.clone(),
            albedo: normalise::round(self.albedo),
            emission: normalise::round(self.emission),
            two_sided: self.two_sided,
        })
    }
}

/// Whether a radiance or an intensity is possible: finite in f32, and not negative.
pub fn is_power(value: DVec3) -> bool {
    value.to_array().iter().all(|&v| v >= 0.0 && (v as f32).is_finite())
}
