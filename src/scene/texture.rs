//! Textures: images that a surface's albedo, emission or opacity vary by.

pub mod decode;
mod files;
mod filter;
mod mapping;
mod mips;
pub mod omitted;
mod texels;

pub(super) use files::Known;
pub use files::{ImageFiles, Part, read_image};
pub use filter::{Filter, Interpolation};
pub use mapping::{Texture, Wrap, on_sphere, on_triangle};
pub use mips::{level_sizes, mip_texels};
pub use texels::Texels;
pub(super) use texels::linear;
