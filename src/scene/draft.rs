//! A scene being read, in the file's own units and f64.

mod images;

use std::path::PathBuf;

use glam::{DVec3, Vec2, Vec3};

use super::shape::UNCOLORED;
use super::{Bsdf, Environment, FovAxis, ImageFiles, SceneError, Texels, Texture, Warning};
use crate::message::location;

/// Triangles, materials, lights and camera as a file gives them. Loaders fill it;
/// [`Draft::finish`] makes the [`Scene`](super::Scene).
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
    /// What the colours of the corners of the triangles multiply the albedo by, linear; what lacks at
    /// the end is 1.
    pub colors: Vec<[Vec3; 3]>,
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

    /// A warning about this place that leaves the image as the file asks for it.
    pub fn note(&self, what: impl AsRef<str>) -> Warning {
        Warning::note(format!("{}: {}", location(&self.file, self.line), what.as_ref()))
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
    pub bsdf: Bsdf,
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

    /// Gives the last triangle colours at its corners.
    pub fn color_last(&mut self, colors: [Vec3; 3]) {
        if colors != UNCOLORED {
            self.colors.resize(self.triangles.len() - 1, UNCOLORED);
            self.colors.push(colors.map(|color| color.clamp(Vec3::ZERO, Vec3::ONE)));
        }
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
}

/// Texture coordinates, or what they are multiplied by: beyond, f32 tells no texels apart, and
/// products might overflow.
fn bounded(uv: Vec2) -> Vec2 {
    uv.clamp(Vec2::splat(-1e9), Vec2::splat(1e9))
}
