//! Attributes of points: what rays that find points store of them beside their records.

use crate::gpu::{Gpu, GpuError};
use crate::render::features::Features;

/// The name by which shaders know an attribute, and four numbers a point.
pub type Attribute = (&'static str, wgpu::Buffer);

/// Buffers for what a scene's features ask to be stored of so many points.
///
/// # Errors
/// The device refuses.
pub fn attributes(
    gpu: &Gpu,
    features: Features,
    points: usize,
) -> Result<Vec<Attribute>, GpuError> {
    let names = [
        ("albedos", features.textures),
        ("emission_scales", features.emission_textures),
        ("throughputs", features.specular()),
    ];
    buffers(gpu, &names, points)
}

/// The same where edges are antialiased: rays see emission by themselves, and what is known of the
/// first rays of a pixel goes with its point.
///
/// # Errors
/// The device refuses.
pub fn ray_attributes(
    gpu: &Gpu,
    features: Features,
    points: usize,
) -> Result<Vec<Attribute>, GpuError> {
    let names = [
        ("albedos", features.textures),
        ("throughputs", features.specular()),
        ("ray_emission", true),
        ("ray_highlights", true),
        ("ray_throughputs", features.specular()),
    ];
    buffers(gpu, &names, points)
}

/// Those that are asked for.
fn buffers(
    gpu: &Gpu,
    names: &[(&'static str, bool)],
    points: usize,
) -> Result<Vec<Attribute>, GpuError> {
    let asked = names.iter().filter(|(_, is)| *is);
    asked.map(|(name, _)| Ok((*name, gpu.storage::<[f32; 4]>(name, points)?))).collect()
}
