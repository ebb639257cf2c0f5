//! Timestamps of the device's own clock: their slots, and what was read back so far.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Dispatches between two read-backs; a query set holds at most 4096 timestamps.
const SLOTS: u32 = 1024;

/// Time that a kernel ran on the device, over all its dispatches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DispatchTimes {
    /// The kernel.
    pub label: &'static str,
    /// How often it was dispatched.
    pub dispatches: u32,
    /// By the device's clock.
    pub time: Duration,
}

/// Collects timestamps dispatch by dispatch.
#[derive(Debug)]
pub(super) struct Timer {
    pub(super) queries: wgpu::QuerySet,
    pub(super) resolved: wgpu::Buffer,
    pub(super) state: Mutex<State>,
}

#[derive(Debug, Default)]
pub(super) struct State {
    /// What has run since the last read-back; a dispatch has two timestamps.
    pub(super) waiting: Vec<&'static str>,
    pub(super) times: Vec<DispatchTimes>,
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

    /// The slots of the next dispatch; none if they are all waiting to be read.
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

    pub(super) fn is_full(&self) -> bool {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).waiting.len() as u32 >= SLOTS
    }
}
