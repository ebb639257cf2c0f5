//! The scene as the renderer sees it: triangles, materials, lights and a camera, in
//! normalised units.
//!
//! Files are read in f64 into a [`Draft`]; [`Draft::finish`] checks it, recentres and scales
//! it ([`Units`]) and only then rounds to f32, so that neither the scene's size nor its
//! distance from the origin changes the image.

mod bare;
mod builtin;
mod camera;
pub(crate) mod document;
mod draft;
mod gltf;
mod mtl;
mod normalise;
mod obj;
mod polygon;
mod toml;

use std::path::Path;

use glam::{DVec3, Vec3};

pub use builtin::BUILTIN_SCENES;
pub use camera::{Camera, FovAxis};
pub use draft::{Draft, DraftCamera, DraftMaterial, Origin};

use crate::error::{SceneError, one_line};

/// A scene ready to be rendered. All lengths are in normalised units, see [`Units`].
#[derive(Debug, Clone)]
pub struct Scene {
    /// The file or `builtin:` name it came from.
    pub name: String,
    /// Where it is seen from.
    pub camera: Camera,
    /// Exposure of the PNG, in EV.
    pub exposure: f32,
    /// All triangles, wound counter-clockwise seen from the side of their normal.
    pub triangles: Vec<Triangle>,
    /// What the triangles are made of.
    pub materials: Vec<Material>,
    /// Point lights; area lights are the triangles of emitting materials.
    pub point_lights: Vec<PointLight>,
    /// How to get back to the units of the file.
    pub units: Units,
    /// Triangles left out because they have no area.
    pub dropped_triangles: u64,
    /// What the user should know about how the scene was read.
    pub warnings: Vec<Warning>,
}

/// A flat triangle. Its geometric normal is that of (v1 - v0) × (v2 - v0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// The corners.
    pub vertices: [Vec3; 3],
    /// Index into [`Scene::materials`].
    pub material: u32,
}

impl Triangle {
    /// The geometric normal, its length twice the area.
    pub fn scaled_normal(&self) -> Vec3 {
        let [a, b, c] = self.vertices;
        (b - a).cross(c - a)
    }

    /// The area, in normalised units squared.
    pub fn area(&self) -> f32 {
        0.5 * self.scaled_normal().length()
    }
}

/// A diffuse surface, lit on both sides, that may emit.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The name it has in the files.
    pub name: String,
    /// Reflectance ρ per channel, in [0, 1]; the BRDF is ρ / π.
    pub albedo: Vec3,
    /// Emitted radiance [W sr⁻¹ m⁻²].
    pub emission: Vec3,
    /// Whether both sides emit, or only that of the geometric normal.
    pub two_sided: bool,
}

impl Material {
    /// Whether its triangles are area lights.
    pub fn emits(&self) -> bool {
        self.emission.max_element() > 0.0
    }
}

/// A light without extent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLight {
    /// Where it is.
    pub position: Vec3,
    /// Radiant intensity, in W sr⁻¹ over [`Units::scale`] squared, so that intensity over
    /// normalised distance squared is irradiance.
    pub intensity: Vec3,
}

/// The map between the file's units and the normalised ones: file = center + scale · normalised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// The centre of the scene's bounds, in the file's units.
    pub center: DVec3,
    /// A power of two, so that scaling a whole scene by one changes no bit of the image.
    pub scale: f64,
}

/// Something about the input that the user should know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// One line; names file and line where there are any.
    pub message: String,
    /// Whether the image is not what the file asks for (an error under `--strict`).
    pub changes_image: bool,
}

impl Warning {
    /// A warning about something that leaves the image as the file asks for it.
    pub fn note(message: impl Into<String>) -> Self {
        Self { message: one_line(message.into()), changes_image: false }
    }

    /// A warning that the image is not what the file asks for.
    pub fn changed(message: impl Into<String>) -> Self {
        Self { message: one_line(message.into()), changes_image: true }
    }
}

impl Scene {
    /// Reads a scene: `builtin:NAME`, a `.toml` scene file, a glTF file or a bare `.obj`.
    ///
    /// # Errors
    /// The file is missing, malformed, or names something that is not supported.
    pub fn load(source: &str) -> Result<Self, SceneError> {
        if let Some(name) = source.strip_prefix("builtin:") {
            return builtin::load(name);
        }
        let path = Path::new(source);
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("toml") => toml::load(path),
            Some("obj") => obj::load_bare(path),
            Some("gltf" | "glb") => gltf::load_bare(path),
            _ => Err(SceneError::new(
                path,
                "unknown kind of scene; give a .toml scene file, an .obj, .gltf, .glb or builtin:NAME",
            )),
        }
    }

    /// Indices of the triangles that emit, in order.
    pub fn emitters(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.triangles).filter_map(|(i, triangle)| {
            self.materials[triangle.material as usize].emits().then_some(i)
        })
    }
}
