//! Passes as data: which kernel, with which buffers, over how many workgroups.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use super::{Gpu, GpuError, Kernel};

/// Buffers bound to a kernel.
#[derive(Debug, Clone)]
pub struct Bindings(pub(super) wgpu::BindGroup);

/// One dispatch.
#[derive(Debug, Clone, Copy)]
pub struct Pass<'a> {
    /// What runs.
    pub kernel: &'a Kernel,
    /// On what.
    pub bindings: &'a Bindings,
    /// Workgroups in x and y.
    pub workgroups: [u32; 2],
}

impl Gpu {
    /// Submits the passes in order, waits for them, and returns how long they took by the
    /// wall clock. The device's own clock is read by [`Gpu::take_pass_times`].
    ///
    /// # Errors
    /// The device fails, runs out of memory, does not finish in time, or the user interrupts.
    pub fn run(&self, passes: &[Pass<'_>]) -> Result<Duration, GpuError> {
        if self.interrupt.load(Ordering::Relaxed) {
            return Err(GpuError::Interrupted);
        }
        let doing = passes.iter().map(|p| p.kernel.label).collect::<Vec<_>>().join(", ");
        let start = Instant::now();
        self.checked(&doing, || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            for pass in passes {
                let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some(pass.kernel.label),
                    timestamp_writes: self.timer.as_ref().and_then(|t| t.writes(pass.kernel.label)),
                });
                compute.set_pipeline(&pass.kernel.pipeline);
                compute.set_bind_group(0, &pass.bindings.0, &[]);
                compute.dispatch_workgroups(pass.workgroups[0], pass.workgroups[1], 1);
            }
            self.queue.submit([encoder.finish()]);
        })?;
        self.wait(&doing)?;
        let time = start.elapsed();
        self.keep_time()?;
        Ok(time)
    }

    /// Sets whole buffers to zero.
    ///
    /// # Errors
    /// As [`Gpu::run`].
    pub fn clear(&self, buffers: &[&wgpu::Buffer]) -> Result<(), GpuError> {
        self.checked("clearing buffers", || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            for buffer in buffers {
                encoder.clear_buffer(buffer, 0, None);
            }
            self.queue.submit([encoder.finish()]);
        })
    }
}
