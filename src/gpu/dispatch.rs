//! Dispatches as data: which kernel, with which buffers, over how many workgroups; and how long each
//! ran by the device's own clock, where the adapter has timestamps.

use std::sync::PoisonError;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use super::timer::Timer;
use super::{Bindings, DispatchTimes, Gpu, GpuError, Kernel};

/// One dispatch.
#[derive(Debug, Clone, Copy)]
pub struct Dispatch<'a> {
    /// What runs.
    pub kernel: &'a Kernel,
    /// On what.
    pub bindings: &'a Bindings,
    /// Workgroups in x and y.
    pub workgroups: [u32; 2],
}

impl Gpu {
    /// Submits the dispatches in order, waits for them, and returns how long they took by the
    /// wall clock. The device's own clock is read by [`Gpu::take_dispatch_times`].
    ///
    /// # Errors
    /// The device fails, runs out of memory, does not finish in time, or the user interrupts.
    pub fn run(&self, dispatches: &[Dispatch<'_>]) -> Result<Duration, GpuError> {
        if self.interrupt.load(Ordering::Relaxed) {
            return Err(GpuError::Interrupted);
        }
        let doing =
            dispatches.iter().map(|dispatch| dispatch.kernel.label).collect::<Vec<_>>().join(", ");
        let start = Instant::now();
        self.checked(&doing, || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            for dispatch in dispatches {
                let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some(dispatch.kernel.label),
                    timestamp_writes: self
                        .timer
                        .as_ref()
                        .and_then(|t| t.writes(dispatch.kernel.label)),
                });
                compute.set_pipeline(&dispatch.kernel.pipeline);
                compute.set_bind_group(0, &dispatch.bindings.0, &[]);
                compute.dispatch_workgroups(dispatch.workgroups[0], dispatch.workgroups[1], 1);
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

impl Gpu {
    /// Reads the timestamps back before they run out of slots.
    fn keep_time(&self) -> Result<(), GpuError> {
        match &self.timer {
            Some(timer) if timer.is_full() => self.collect_times(timer),
            _ => Ok(()),
        }
    }

    /// How long each kernel ran since the last call, in the order of first use; empty where
    /// the adapter has no timestamps.
    ///
    /// # Errors
    /// The device fails.
    pub fn take_dispatch_times(&self) -> Result<Vec<DispatchTimes>, GpuError> {
        let Some(timer) = &self.timer else { return Ok(Vec::new()) };
        self.collect_times(timer)?;
        let mut state = timer.state.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(std::mem::take(&mut state.times))
    }

    fn collect_times(&self, timer: &Timer) -> Result<(), GpuError> {
        let waiting = {
            let mut state = timer.state.lock().unwrap_or_else(PoisonError::into_inner);
            std::mem::take(&mut state.waiting)
        };
        if waiting.is_empty() {
            return Ok(());
        }
        self.checked("reading timestamps", || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            let stamps = 0..2 * waiting.len() as u32;
            encoder.resolve_query_set(&timer.queries, stamps, &timer.resolved, 0);
            self.queue.submit([encoder.finish()]);
        })?;
        let stamps: Vec<[u64; 2]> = self.read(&timer.resolved, waiting.len())?;
        let period = f64::from(self.queue.get_timestamp_period()) * 1e-9;
        let mut state = timer.state.lock().unwrap_or_else(PoisonError::into_inner);
        for (label, [start, end]) in waiting.into_iter().zip(stamps) {
            let time = Duration::from_secs_f64(end.saturating_sub(start) as f64 * period);
            match state.times.iter_mut().find(|known| known.label == label) {
                Some(known) => {
                    known.dispatches += 1;
                    known.time += time;
                }
                None => state.times.push(DispatchTimes { label, dispatches: 1, time }),
            }
        }
        Ok(())
    }
}
