//! Surfaces on the host: what a ray has hit, and how light goes on from there. The twins of
//! `shaders/materials/`.

pub mod bsdf;
pub mod hit;
