//! A compiled program, and the buffers bound to it by name.

use super::{Gpu, GpuError, Linked, Module, Program, Texture};

/// A program compiled for a device.
#[derive(Debug)]
pub struct Kernel {
    /// Its name in reports.
    pub label: &'static str,
    /// The files linked into it.
    pub modules: Vec<&'static Module>,
    pub(super) pipeline: wgpu::ComputePipeline,
    bindings: Vec<(String, u32)>,
}

/// Buffers bound to a kernel.
#[derive(Debug, Clone)]
pub struct Bindings(pub(super) wgpu::BindGroup);

impl Gpu {
    /// Links and compiles a program. (Some drivers compile only at the first dispatch.)
    ///
    /// # Errors
    /// The program is not valid, or the device refuses it.
    pub fn compile(&self, program: &Program) -> Result<Kernel, GpuError> {
        let Linked { module, bindings, .. } = program.link()?;
        let pipeline = self.checked(program.label, || {
            let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(program.label),
                source: wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(module)),
            });
            // The default layout holds the bindings that the entry point uses, and no others.
            self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(program.label),
                layout: None,
                module: &module,
                entry_point: Some("main"),
                compilation_options: Default::default(),
                cache: None,
            })
        })?;
        Ok(Kernel { label: program.label, modules: program.modules.clone(), pipeline, bindings })
    }

    /// Binds buffers to a kernel's variables of the same names. Buffers that the kernel does
    /// not use are passed over.
    ///
    /// # Errors
    /// A variable has no buffer: a fault of this program.
    pub fn bind(
        &self,
        kernel: &Kernel,
        buffers: &[(&str, &wgpu::Buffer)],
    ) -> Result<Bindings, GpuError> {
        self.bind_with(kernel, buffers, &[])
    }

    /// The same, with tables in textures as well.
    ///
    /// # Errors
    /// As [`Gpu::bind`].
    pub fn bind_with(
        &self,
        kernel: &Kernel,
        buffers: &[(&str, &wgpu::Buffer)],
        textures: &[(&str, &Texture)],
    ) -> Result<Bindings, GpuError> {
        let entries = kernel
            .bindings
            .iter()
            .map(|(name, binding)| {
                let buffer = buffers.iter().find(|(known, _)| known == name);
                let texture = textures.iter().find(|(known, _)| known == name);
                let resource = match (buffer, texture) {
                    (Some((_, buffer)), _) => buffer.as_entire_binding(),
                    (None, Some((_, texture))) => wgpu::BindingResource::TextureView(&texture.view),
                    (None, None) => {
                        let what = format!("{}: no buffer for '{name}'", kernel.label);
                        return Err(GpuError::Invalid(what));
                    }
                };
                Ok(wgpu::BindGroupEntry { binding: *binding, resource })
            })
            .collect::<Result<Vec<_>, GpuError>>()?;
        self.checked(kernel.label, || {
            Bindings(self.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(kernel.label),
                layout: &kernel.pipeline.get_bind_group_layout(0),
                entries: &entries,
            }))
        })
    }
}
