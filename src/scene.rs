//! The scene as the renderer sees it: triangles, materials, lights and a camera, in
//! normalised units.
//!
//! Files are read in f64 into a [`Draft`]; [`Draft::finish`] checks it, recentres and scales
//! it ([`Units`]) and only then rounds to f32, so that neither the scene's size nor its
//! distance from the origin changes the image.

mod bare;
mod builtin;
mod camera;
mod contents;
mod coplanar;
pub(crate) mod document;
mod draft;
pub mod environment;
mod error;
mod finish;
mod formats;
mod gltf;
mod light;
mod load;
mod material;
mod mesh;
mod mtl;
mod names;
mod normalise;
mod obj;
pub mod omission;
mod polygon;
mod shape;
pub(crate) mod text;
pub mod texture;
mod toml;
mod units;
mod warning;

pub use builtin::BUILTIN_SCENES;
pub use camera::{Camera, FovAxis};
pub use contents::Scene;
pub use draft::{Draft, DraftCamera, DraftMaterial, DraftSphere, DraftSpot, Origin};
pub use environment::{Environment, EnvironmentImage};
pub use error::SceneError;
pub use formats::omissions;
pub use light::{Cone, DirectionalLight, PointLight};
pub use material::{Bsdf, Material};
pub use shape::{Sphere, Triangle};
pub use texture::{ImageFiles, Texels, Texture, Wrap};
pub use units::Units;
pub use warning::Warning;
