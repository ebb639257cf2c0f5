//! Materials: every BSDF by itself, surfaces that have one, and textures.

#[path = "../common/mod.rs"]
mod common;

mod scattering;
mod surfaces;
mod textures;
mod vertex_colors;
