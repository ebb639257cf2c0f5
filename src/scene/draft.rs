//! A scene being read, in the file's own units and f64.

use std::path::PathBuf;

use glam::{DVec3, Vec2, Vec3};

use super::{
    Environment, Finish, FovAxis, ImageFiles, Material, Scene, Texels, Texture, Warning, camera,
    normalise,
};
use crate::error::{SceneError, location};

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
    /// Texture coordinates of the corners of the triangles, from the image's top left; what lacks
    /// at the end is 0.
    pub uvs: Vec<[Vec2; 3]>,
    /// All spheres.
    pub spheres: Vec<DraftSphere>,
    /// All materials met so far.
    pub materials: Vec<DraftMaterial>,
    /// What materials vary by.
    pub textures: Vec<Texture>,
    /// The images of the textures.
    pub images: Vec<Texels>,
    /// Which of them were read from files.
    pub image_files: ImageFiles,
    /// Position, and intensity in W/sr.
    pub point_lights: Vec<(DVec3, DVec3)>,
    /// Lights that shine into a cone.
    pub spot_lights: Vec<DraftSpot>,
    /// Direction in which the light goes, of any length, and irradiance in W/m².
    pub directional_lights: Vec<(DVec3, DVec3)>,
    /// Light from all directions.
    pub environment: Option<Environment>,
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

    /// A warning that something at this place is shown otherwise than it asks for.
    pub fn changed(&self, what: impl AsRef<str>) -> Warning {
        Warning::changed(format!("{}: {}", location(&self.file, self.line), what.as_ref()))
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

/// A sphere in the file's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DraftSphere {
    /// The centre.
    pub center: DVec3,
    /// The radius.
    pub radius: f64,
    /// The material's index.
    pub material: u32,
}

/// A spot light in the file's units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DraftSpot {
    /// Where it is.
    pub position: DVec3,
    /// Where it points, of any length.
    pub direction: DVec3,
    /// Intensity along its axis in W/sr.
    pub intensity: DVec3,
    /// Angles in degrees between the axis and where it begins to fade, and where it ends.
    pub angles: [f64; 2],
}

/// A material in f64.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DraftMaterial {
    /// Its name in the files.
    pub name: String,
    /// Diffuse reflectance per channel.
    pub albedo: DVec3,
    /// The texture that the albedo is multiplied by.
    pub texture: Option<u32>,
    /// The texture whose alpha below one half is no surface.
    pub cutout: Option<u32>,
    /// How it reflects beside its diffuse part.
    pub finish: Finish,
    /// Emitted radiance.
    pub emission: DVec3,
    /// The texture that the emission is multiplied by.
    pub emission_texture: Option<u32>,
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

    /// Adds a triangle: its corners, their texture coordinates, and its material's index.
    pub fn add_triangle(&mut self, corners: [DVec3; 3], uvs: [Vec2; 3], material: u32) {
        self.uvs.resize(self.triangles.len(), [Vec2::ZERO; 3]);
        self.triangles.push((corners, material));
        self.uvs.push(uvs.map(bounded));
    }

    /// Adds an image and returns its index.
    pub fn add_image(&mut self, image: Texels) -> u32 {
        self.images.push(image);
        self.images.len() as u32 - 1
    }

    /// Adds a texture, if there is none like it, and returns its index.
    pub fn add_texture(&mut self, texture: Texture) -> u32 {
        let (scale, offset) = (bounded(texture.scale), bounded(texture.offset));
        let texture = Texture { scale, offset, ..texture };
        let index = self.textures.iter().position(|known| *known == texture);
        let index = index.unwrap_or_else(|| {
            self.textures.push(texture);
            self.textures.len() - 1
        });
        index as u32
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
        self.uvs.resize(self.triangles.len(), [Vec2::ZERO; 3]);
        let mesh = normalise::shapes(&origin, &self, &materials)?;
        let point_lights = normalise::point_lights(&origin, &self, &mesh.units)?;
        let directional_lights = normalise::directional_lights(&origin, &self.directional_lights)?;
        let textured = materials.iter().any(|material| material.textures().next().is_some());
        let mut warnings = self.warnings;
        warnings.extend(mesh.warnings);
        let scene = Scene {
            name: self.name,
            camera: camera::finish(&draft_camera, &mesh.units)?,
            exposure: self.exposure as f32,
            triangles: mesh.triangles,
            uvs: if textured { mesh.uvs } else { Vec::new() },
            spheres: mesh.spheres,
            materials,
            textures: self.textures,
            images: self.images,
            point_lights,
            directional_lights,
            environment: self.environment,
            units: mesh.units,
            dropped_triangles: mesh.dropped,
            warnings,
        };
        if !scene.is_lit() {
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
        let finish = self.finish;
        if let Some(what) = impossible(&finish, normalise::round(self.albedo)) {
            return Err(self.origin.error(format!("material `{}`: {what}", self.name)));
        }
        Ok(Material {
            name: self.name.clone(),
            albedo: normalise::round(self.albedo),
            texture: self.texture,
            cutout: self.cutout,
            finish,
            emission: normalise::round(self.emission),
            emission_texture: self.emission_texture,
            two_sided: self.two_sided,
        })
    }
}

/// What is wrong with a finish over a diffuse albedo.
fn impossible(finish: &Finish, albedo: Vec3) -> Option<&'static str> {
    /// What the sum of two rounded reflectances may exceed 1 by.
    const ROUNDING: f32 = 1e-5;
    let within = |color: Vec3| color.to_array().iter().all(|c| (0.0..=1.0).contains(c));
    match *finish {
        Finish::Diffuse => None,
        Finish::Phong { specular, .. }
        | Finish::Mirror { specular }
        | Finish::Glass { specular, .. }
            if !within(specular) =>
        {
            Some("specular is not within 0 and 1")
        }
        // Light would take no notice of it, but images of the reflectance would.
        Finish::Mirror { .. } | Finish::Glass { .. } if albedo != Vec3::ZERO => {
            Some("mirror and glass have no albedo; make it 0")
        }
        Finish::Phong { specular, .. } if (specular + albedo).max_element() > 1.0 + ROUNDING => {
            Some("albedo and specular together exceed 1; lower one of them")
        }
        Finish::Phong { shininess, .. } if !(0.0..=1e6).contains(&shininess) => {
            Some("shininess is not within 0 and 1e6")
        }
        Finish::Glass { ior, .. } if !(0.1..=10.0).contains(&ior) => {
            Some("ior is not within 0.1 and 10")
        }
        _ => None,
    }
}

/// Texture coordinates, or what they are multiplied by: beyond, f32 tells no texels apart, and
/// products might overflow.
fn bounded(uv: Vec2) -> Vec2 {
    uv.clamp(Vec2::splat(-1e9), Vec2::splat(1e9))
}

/// Whether a radiance or an intensity is possible: finite in f32, and not negative.
pub fn is_power(value: DVec3) -> bool {
    value.to_array().iter().all(|&v| v >= 0.0 && (v as f32).is_finite())
}
