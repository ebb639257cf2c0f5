//! The stages of a frame: kernels with the buffers of a tile bound to them. What a frame does
//! not need is not there.

use std::sync::Arc;
use std::time::Duration;

use super::film::{BLOCK, TILE_BLOCKS, image_blocks};
use super::{Direct, Prepared, Settings, kernels};
use crate::gpu::{Bindings, CameraParams, GpuError, Kernel, Pass, PointRecord, Program};
use crate::scene::Camera;

/// Words of 32 VPLs that the bit matrix holds at a time: 8 MiB a tile. Also fixes the order
/// of the sums, so it is no matter of tuning.
pub const MATRIX_WORDS: u32 = 32;

/// The VPLs of a frame on the device.
#[derive(Debug)]
pub struct Indirect {
    /// How many there are.
    pub count: u32,
    /// Filled up to whole words.
    pub buffer: wgpu::Buffer,
    /// The bound on G, in normalised units.
    pub bound: Option<f32>,
}

/// A kernel with its buffers bound, and the buffer of its parameters.
#[derive(Debug)]
pub struct Stage {
    kernel: Arc<Kernel>,
    bindings: Bindings,
    params: wgpu::Buffer,
}

/// The stages of a frame, and the buffers that the host clears or reads.
#[derive(Debug)]
pub struct Stages {
    /// Radiance, summed over the samples; in w how many of them hit something.
    pub film: wgpu::Buffer,
    /// Indirect radiance that was reflected and that the clamp removed.
    pub energy: Option<wgpu::Buffer>,
    /// Irradiance of the kind of light being gathered.
    pub irradiance: Option<wgpu::Buffer>,
    /// Shadow rays to VPLs.
    pub counter: wgpu::Buffer,
    /// Camera rays.
    pub visible: Stage,
    /// The picture of a method without light.
    pub show: Option<Stage>,
    /// Emission towards the camera.
    pub emit: Option<Stage>,
    /// Direct light from point lights.
    pub direct_point: Option<Stage>,
    /// Direct light from area lights.
    pub direct_area: Option<Stage>,
    /// Shadow rays between points and VPLs.
    pub visibility: Option<Stage>,
    /// Shading of points by VPLs.
    pub shade: Option<Stage>,
    /// Irradiance to radiance.
    pub reflect: Option<Stage>,
    /// What the clamp removed.
    pub removed: Option<Stage>,
}

impl Stages {
    /// Allocates the buffers of a tile and binds the kernels that a frame needs.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        camera: &Camera,
        settings: &Settings,
        indirect: Option<&Indirect>,
    ) -> Result<Self, GpuError> {
        let gpu = &prepared.gpu;
        let points = (image_blocks(camera).min(TILE_BLOCKS) * BLOCK) as usize;
        let lit = settings.method.is_lit();
        let direct = lit && settings.direct == Direct::PerPixel;
        let bounced = indirect.is_some();
        let clamps = indirect.is_some_and(|indirect| indirect.bound.is_some());
        let words = indirect.map_or(0, |i| i.count.div_ceil(32).min(MATRIX_WORDS)) as usize;

        let film = gpu.storage::<[f32; 4]>("film", points)?;
        let counter = gpu.storage::<u32>("ray counter", 3)?;
        let records = gpu.storage::<PointRecord>("visible points", points)?;
        let energy = clamps.then(|| gpu.storage::<[f32; 2]>("energy", points)).transpose()?;
        let irradiance = (direct || bounced)
            .then(|| gpu.storage::<[f32; 4]>("irradiance", points))
            .transpose()?;
        let bits =
            bounced.then(|| gpu.storage::<u32>("visibility bits", points * words)).transpose()?;

        let mut buffers = vec![
            ("nodes", &prepared.nodes),
            ("triangles", &prepared.triangles),
            ("materials", &prepared.materials),
            ("points", &records),
            ("film", &film),
            ("counter", &counter),
        ];
        buffers.extend(indirect.map(|indirect| ("vpls", &indirect.buffer)));
        buffers.extend(energy.as_ref().map(|energy| ("energy", energy)));
        buffers.extend(irradiance.as_ref().map(|irradiance| ("irradiance", irradiance)));
        buffers.extend(bits.as_ref().map(|bits| ("bits", bits)));

        let bind = |program: Program, lights: Option<&wgpu::Buffer>| {
            let kernel = prepared.kernels.get(gpu, &program)?;
            // The largest of the parameter records; a kernel reads its own.
            let params = gpu.uniform::<CameraParams>("parameters")?;
            let mut buffers = buffers.clone();
            buffers.push(("params", &params));
            buffers.extend(lights.map(|lights| ("lights", lights)));
            let bindings = gpu.bind(&kernel, &buffers)?;
            Ok::<_, GpuError>(Stage { kernel, bindings, params })
        };
        let when = |is: bool, program: Program| is.then(|| bind(program, None)).transpose();
        let point_lights = prepared.point_lights.as_ref().filter(|_| direct);
        let area_lights = prepared.area_lights.as_ref().filter(|_| direct);
        let subgroups = gpu.has_subgroups();
        let show = kernels::show(settings.method);
        Ok(Self {
            visible: bind(kernels::visible_points(subgroups), None)?,
            show: show.map(|program| bind(program, None)).transpose()?,
            emit: when(lit && prepared.area_lights.is_some(), kernels::emit())?,
            direct_point: point_lights
                .map(|lights| bind(kernels::direct_point(subgroups), Some(lights)))
                .transpose()?,
            direct_area: area_lights
                .map(|lights| bind(kernels::direct_area(subgroups), Some(lights)))
                .transpose()?,
            visibility: when(bounced, kernels::visibility_for(prepared))?,
            shade: when(bounced, kernels::shade(subgroups, clamps))?,
            reflect: when(direct || bounced, kernels::reflect())?,
            removed: when(clamps, kernels::removed())?,
            film,
            energy,
            irradiance,
            counter,
        })
    }
}

impl Stage {
    /// Runs the stage over so many workgroups and waits for it.
    ///
    /// # Errors
    /// The device fails.
    pub fn run<P: bytemuck::Pod>(
        &self,
        prepared: &Prepared,
        params: &P,
        workgroups: [u32; 2],
    ) -> Result<Duration, GpuError> {
        if size_of::<P>() > 0 {
            prepared.gpu.write(&self.params, std::slice::from_ref(params))?;
        }
        let (kernel, bindings) = (&*self.kernel, &self.bindings);
        prepared.gpu.run(&[Pass { kernel, bindings, workgroups }])
    }
}
