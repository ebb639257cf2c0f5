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
pub mod environment;
mod gltf;
mod mesh;
mod mtl;
mod normalise;
mod obj;
mod polygon;
pub mod texture;
mod toml;

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};

pub use builtin::BUILTIN_SCENES;
pub use camera::{Camera, FovAxis};
pub use draft::{Draft, DraftCamera, DraftMaterial, DraftSphere, DraftSpot, Origin};
pub use environment::{Environment, EnvironmentImage};
pub use texture::{ImageFiles, Texels, Texture, Wrap};

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
    /// Texture coordinates of the corners of each triangle; none where no material has a texture.
    pub uvs: Vec<[Vec2; 3]>,
    /// All spheres.
    pub spheres: Vec<Sphere>,
    /// What triangles and spheres are made of.
    pub materials: Vec<Material>,
    /// What materials vary by.
    pub textures: Vec<Texture>,
    /// The images of the textures.
    pub images: Vec<Texels>,
    /// Point and spot lights; area lights are the triangles and spheres of emitting materials.
    pub point_lights: Vec<PointLight>,
    /// Lights infinitely far away, in one direction each.
    pub directional_lights: Vec<DirectionalLight>,
    /// Light from all directions.
    pub environment: Option<Environment>,
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

/// A sphere. Its normal points outwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// The centre.
    pub center: Vec3,
    /// The radius.
    pub radius: f32,
    /// Index into [`Scene::materials`].
    pub material: u32,
}

/// How a surface reflects beside its diffuse part.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Finish {
    /// Not at all: the BRDF is ρ / π.
    #[default]
    Diffuse,
    /// Modified Phong (Lafortune and Willems, "Using the Modified Phong Reflectance Model for
    /// Physically Based Rendering", 1994): the BRDF is ρ / π + k_s (n + 2) / 2π cosⁿ α, with α
    /// the angle from the mirrored direction.
    Phong {
        /// k_s per channel; with the albedo at most 1.
        specular: Vec3,
        /// n.
        shininess: f32,
    },
    /// An ideal mirror.
    Mirror {
        /// Reflectance per channel.
        specular: Vec3,
    },
    /// A smooth dielectric, the inside behind its normal.
    Glass {
        /// What of the light goes on, per channel, reflected or refracted.
        specular: Vec3,
        /// Index of refraction of the inside over that of the outside.
        ior: f32,
    },
}

impl Finish {
    /// Whether light is reflected or refracted into single directions only.
    pub fn is_specular(&self) -> bool {
        matches!(self, Self::Mirror { .. } | Self::Glass { .. })
    }
}

/// A surface, lit on both sides, that may emit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Material {
    /// The name it has in the files.
    pub name: String,
    /// Diffuse reflectance ρ per channel, in [0, 1]; the BRDF is ρ / π, and what its finish adds.
    pub albedo: Vec3,
    /// Index into [`Scene::textures`] of what the albedo is multiplied by.
    pub texture: Option<u32>,
    /// Index into [`Scene::textures`] of the texture where whose alpha is below one half there is
    /// no surface.
    pub cutout: Option<u32>,
    /// How it reflects beside its diffuse part.
    pub finish: Finish,
    /// Emitted radiance [W sr⁻¹ m⁻²].
    pub emission: Vec3,
    /// Index into [`Scene::textures`] of what the emission is multiplied by.
    pub emission_texture: Option<u32>,
    /// Whether both sides emit, or only that of the geometric normal.
    pub two_sided: bool,
}

impl Material {
    /// Whether its triangles and spheres are area lights.
    pub fn emits(&self) -> bool {
        self.emission.max_element() > 0.0
    }

    /// Indices of its textures.
    pub fn textures(&self) -> impl Iterator<Item = u32> + use<> {
        [self.texture, self.cutout, self.emission_texture].into_iter().flatten()
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

/// The map between the file's units and the normalised ones: file = center + scale · normalised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// The centre of the scene's bounds, in the file's units.
    pub center: DVec3,
    /// Half of the longest extent, so that normalised units are the same whatever those of the
    /// file: what decides by a bit, as ties of K-means, decides alike.
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

    /// Whether any light is not black.
    pub fn is_lit(&self) -> bool {
        let sphere = |sphere: &Sphere| self.materials[sphere.material as usize].emits();
        self.point_lights.iter().any(|light| light.intensity.max_element() > 0.0)
            || self.directional_lights.iter().any(|light| light.irradiance.max_element() > 0.0)
            || self.environment.as_ref().is_some_and(Environment::shines)
            || self.emitters().next().is_some()
            || self.spheres.iter().any(sphere)
    }

    /// Whether light meets mirrors or glass.
    pub fn has_specular(&self) -> bool {
        let specular = |material: u32| self.materials[material as usize].finish.is_specular();
        self.triangles.iter().any(|triangle| specular(triangle.material))
            || self.spheres.iter().any(|sphere| specular(sphere.material))
    }

    /// Whether mirrors or glass may turn light that has no extent, which paths from the camera never
    /// run into.
    pub fn has_hidden_caustics(&self) -> bool {
        let points = self.point_lights.len() + self.directional_lights.len();
        points > 0 && self.has_specular()
    }

    /// How many light sources there are; each triangle and sphere that emits is one.
    pub fn light_count(&self) -> usize {
        let emits = |sphere: &&Sphere| self.materials[sphere.material as usize].emits();
        self.point_lights.len()
            + self.directional_lights.len()
            + usize::from(self.environment.is_some())
            + self.emitters().count()
            + self.spheres.iter().filter(emits).count()
    }

    /// Indices of the triangles that emit, in order.
    pub fn emitters(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.triangles).filter_map(|(i, triangle)| {
            self.materials[triangle.material as usize].emits().then_some(i)
        })
    }
}
