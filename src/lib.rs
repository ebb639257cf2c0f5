//! Headless global illumination with virtual point lights (VPLs, instant radiosity) on any
//! wgpu adapter.
//!
//! Data flows one way:
//!
//! ```text
//! scene → bvh → visible points → VPLs → visibility → shading → image
//! ```

pub mod bvh;
pub mod cli;
pub mod error;
pub mod gpu;
pub mod image;
pub mod render;
pub mod report;
pub mod sampling;
pub mod scene;
