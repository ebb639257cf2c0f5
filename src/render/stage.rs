//! A stage: a kernel with the buffers that it works on.

use std::sync::Arc;
use std::time::Duration;

use super::prepared::Prepared;
use crate::gpu::{Bindings, CameraParams, Dispatch, GpuError, Kernel, Program, Texture};

/// A buffer and the name by which shaders know it.
pub type Named<'a> = (&'a str, &'a wgpu::Buffer);

/// A table in a texture and the name by which shaders know it.
pub type NamedTexture<'a> = (&'a str, &'a Texture);

/// A kernel with its buffers bound, and the buffer of its parameters.
#[derive(Debug)]
pub struct Stage {
    kernel: Arc<Kernel>,
    bindings: Bindings,
    params: wgpu::Buffer,
}

impl Stage {
    /// Binds buffers to the kernel of a program.
    ///
    /// # Errors
    /// The device refuses.
    pub fn new(
        prepared: &Prepared,
        program: &Program,
        buffers: &[Named<'_>],
    ) -> Result<Self, GpuError> {
        Self::with_textures(prepared, program, buffers, &[])
    }

    /// The same, with tables in textures beside those of the scene.
    ///
    /// # Errors
    /// The device refuses.
    pub fn with_textures(
        prepared: &Prepared,
        program: &Program,
        buffers: &[Named<'_>],
        textures: &[NamedTexture<'_>],
    ) -> Result<Self, GpuError> {
        let kernel = prepared.kernel(program.clone())?;
        // The largest of the parameter records; a kernel reads its own.
        let params = prepared.gpu.parameters::<CameraParams>("parameters")?;
        let buffers = [buffers, &[("params", &params)]].concat();
        let tables = prepared.textures.iter().map(|texture| (texture.name, texture));
        let textures: Vec<_> = textures.iter().copied().chain(tables).collect();
        let bindings = prepared.gpu.bind_with(&kernel, &buffers, &textures)?;
        Ok(Self { kernel, bindings, params })
    }

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
        prepared.gpu.run(&[Dispatch { kernel, bindings, workgroups }])
    }
}
