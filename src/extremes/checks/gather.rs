//! The shading kernel by itself, on points and lights made by hand.

use bytemuck::Zeroable;
use glam::Vec3;

use crate::gpu::{Dispatch, Gpu, GpuError, PointRecord, ShadeParams, VplRecord};
use crate::render::Sharing;
use crate::render::Target;
use crate::render::kernels::{Emitter, shade};

/// A point of a surface, seen from straight above.
pub fn point(position: Vec3, normal: Vec3) -> PointRecord {
    let (position, normal) = (position.to_array(), normal.to_array());
    PointRecord { position, surface: 0, normal, depth: 0.0 }.seen_from(normal)
}

/// A diffuse VPL.
pub fn vpl(position: Vec3, normal: Vec3, intensity: Vec3) -> VplRecord {
    VplRecord {
        position: position.to_array(),
        pad0: 0.0,
        normal: normal.to_array(),
        bound: 0.0,
        intensity: intensity.to_array(),
        mean: intensity.element_sum() / 3.0,
    }
}

/// Who sees whom: words of 32 VPLs for every point, then the next; they begin with the VPLs'
/// word `matrix_word`.
#[derive(Debug, Clone, Copy)]
pub struct Matrix<'a> {
    /// The words.
    pub bits: &'a [u32],
    /// The VPLs' word with which they begin.
    pub matrix_word: u32,
}

/// Irradiance of the same VPLs so many times over, each time on top of what is there.
///
/// # Errors
/// The device fails.
pub fn repeated(
    gpu: &Gpu,
    points: &[PointRecord],
    vpls: &[VplRecord],
    matrix: Matrix<'_>,
    times: u32,
) -> Result<Vec<[f32; 4]>, GpuError> {
    let result = gpu.storage_of("irradiance", &vec![[0.0f32; 4]; points.len()])?;
    add(gpu, None, points, vpls, matrix, &result, times)?;
    gpu.read(&result, points.len())
}

/// Irradiance, and in w what the bound removed, on top of `before`.
///
/// # Errors
/// The device fails.
pub fn irradiance(
    gpu: &Gpu,
    bound: Option<f32>,
    points: &[PointRecord],
    vpls: &[VplRecord],
    matrix: Matrix<'_>,
    before: [f32; 4],
) -> Result<Vec<[f32; 4]>, GpuError> {
    let result = gpu.storage_of("irradiance", &vec![before; points.len()])?;
    add(gpu, bound, points, vpls, matrix, &result, 1)?;
    gpu.read(&result, points.len())
}

fn add(
    gpu: &Gpu,
    bound: Option<f32>,
    points: &[PointRecord],
    vpls: &[VplRecord],
    matrix: Matrix<'_>,
    result: &wgpu::Buffer,
    times: u32,
) -> Result<(), GpuError> {
    let target = Target::plain(gpu.has_subgroups());
    let kernel = gpu.compile(&shade(target, bound.is_some(), Sharing::Own, Emitter::Surface))?;
    let params = gpu.parameters::<ShadeParams>("params")?;
    let count = points.len() as u32;
    let Matrix { bits, matrix_word } = matrix;
    let record = ShadeParams {
        points: count,
        rows: count,
        matrix_word,
        words: bits.len() as u32 / count,
        first_point: 0,
        pad: [0; 3],
    };
    gpu.write(&params, &[record])?;
    // Filled up to whole words with lights of no intensity, as the renderer does.
    let mut whole = vpls.to_vec();
    whole.iter_mut().for_each(|vpl| vpl.bound = bound.unwrap_or(0.0));
    whole.resize(vpls.len().next_multiple_of(32), VplRecord::zeroed());
    let buffers = [
        ("params", &params),
        ("points", &gpu.storage_of("points", points)?),
        ("vpls", &gpu.storage_of("vpls", &whole)?),
        ("bits", &gpu.storage_of("bits", bits)?),
        ("irradiance", result),
    ];
    let bindings = gpu.bind(&kernel, &buffers)?;
    // With subgroups an invocation has four points.
    let each = if gpu.has_subgroups() { 4 * 64 } else { 64 };
    let workgroups = [points.len().div_ceil(each) as u32, 1];
    for _ in 0..times {
        gpu.run(&[Dispatch { kernel: &kernel, bindings: &bindings, workgroups }])?;
    }
    Ok(())
}
