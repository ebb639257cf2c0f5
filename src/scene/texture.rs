//! Textures: images that a surface's albedo, emission or opacity vary by.

pub mod decode;
mod files;
mod mapping;
mod texels;

pub(super) use files::Known;
pub use files::{ImageFiles, Part, read_image};
pub use mapping::{Texture, Wrap, on_sphere, on_triangle};
pub use texels::Texels;
pub(super) use texels::linear;
