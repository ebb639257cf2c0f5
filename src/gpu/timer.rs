//! The device's own clock: how long each pass ran, where the adapter has timestamps.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::{Gpu, GpuError};

/// Passes between two read-backs; a query set holds at most 4096 timestamps.
const SLOTS: u32 = 1024;

/// Time that a kernel ran on the device, over all its dispatches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassTime {
    /// The kernel.
    pub label: &'static str,
    /// How often it was dispatched.
    pub dispatches: u32,
    /// By the device's clock.
    pub time: Duration,
}

/// Collects timestamps pass by pass.
#[derive(Debug)]
pub(super) struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// What has run since the last read-back; a pass has two timestamps.
    waiting: Vec<&'static str>,
    times: Vec<PassTime>,
}

impl Timer {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        Self {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * SLOTS,
            }),
            resolved: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: 16 * u64::from(SLOTS),
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            state: Mutex::default(),
        }
    }

    /// The slots of the next pass; none if they are all waiting to be read.
    pub(super) fn writes(
        &self,
        label: &'static str,
    ) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let slot = state.waiting.len() as u32;
        if slot >= SLOTS {
            return None;
        }
        state.waiting.push(label);
        Some(wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(2 * slot),
            end_of_pass_write_index: Some(2 * slot + 1),
        })
    }

    fn is_full(&self) -> bool {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).waiting.len() as u32 >= SLOTS
    }
}

impl Gpu {
    /// Reads the timestamps back before they run out of slots.
    pub(super) fn keep_time(&self) -> Result<(), GpuError> {
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
    pub fn take_pass_times(&self) -> Result<Vec<PassTime>, GpuError> {
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
                None => state.times.push(PassTime { label, dispatches: 1, time }),
            }
        }
        Ok(())
    }
}
