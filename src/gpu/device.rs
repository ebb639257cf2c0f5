//! The open device: errors of the driver become errors of ours, and waits have an end.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use super::adapter::{self, AdapterChoice, AdapterInfo};
use super::error::GpuError;
use super::timer::Timer;

/// How long one submission may take before the device counts as hung. Dispatches are sized
/// for well under a second; the rest is for shader compilation and busy machines.
const WAIT: Duration = Duration::from_secs(180);

/// An open device. A clone is the same device.
#[derive(Debug, Clone)]
pub struct Gpu {
    /// What it is.
    pub info: AdapterInfo,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    subgroups: bool,
    /// Where the adapter has timestamps.
    pub(super) timer: Option<Arc<Timer>>,
    lost: Arc<AtomicBool>,
    /// Set from outside to stop at the next submission.
    pub(super) interrupt: Arc<AtomicBool>,
    /// Errors that no scope caught (wgpu's default is to panic).
    uncaptured: Arc<Mutex<Option<wgpu::Error>>>,
}

impl Gpu {
    /// Opens the adapter chosen.
    ///
    /// # Errors
    /// There is none, none of that name, or it cannot be opened.
    pub fn open(choice: &AdapterChoice) -> Result<Self, GpuError> {
        let adapter = adapter::choose(choice)?;
        let info = adapter::describe(&adapter.get_info());
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("gpu-vpl"),
            required_features: adapter::useful_features(&adapter),
            required_limits: adapter.limits(),
            ..Default::default()
        }))
        .map_err(|error| GpuError::CannotOpen {
            name: info.name.clone(),
            why: error.to_string(),
        })?;

        let lost = Arc::new(AtomicBool::new(false));
        let flag = lost.clone();
        device.set_device_lost_callback(move |_, _| flag.store(true, Ordering::Relaxed));
        let uncaptured = Arc::new(Mutex::new(None));
        let slot = uncaptured.clone();
        device.on_uncaptured_error(Arc::new(move |error| {
            if let Ok(mut slot) = slot.lock() {
                slot.get_or_insert(error);
            }
        }));
        let subgroups = device.features().contains(wgpu::Features::SUBGROUP)
            && device.adapter_info().subgroup_min_size >= 8;
        let stamps = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let timer = stamps.then(|| Arc::new(Timer::new(&device)));
        let interrupt = Arc::default();
        Ok(Self { info, device, queue, subgroups, timer, lost, interrupt, uncaptured })
    }

    /// The same device, which refuses to run anything once the flag is set.
    pub fn interrupted_by(mut self, flag: Arc<AtomicBool>) -> Self {
        self.interrupt = flag;
        self
    }

    /// The limits of the device, which are those of the adapter.
    pub fn limits(&self) -> wgpu::Limits {
        self.device.limits()
    }

    /// Whether kernels that share loads across at least 8 lanes can run here.
    pub fn has_subgroups(&self) -> bool {
        self.subgroups
    }

    /// The same device, made to run the plain kernels, as an adapter without subgroups does.
    pub fn without_subgroups(mut self) -> Self {
        self.subgroups = false;
        self
    }

    /// Runs `work` and turns what the device complains about meanwhile into an error.
    pub(super) fn checked<T>(&self, doing: &str, work: impl FnOnce() -> T) -> Result<T, GpuError> {
        let scopes = [
            wgpu::ErrorFilter::Internal,
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Validation,
        ]
        .map(|filter| self.device.push_error_scope(filter));
        let result = work();
        // Scopes end in the reverse of the order in which they began.
        let mut first = None;
        for scope in scopes.into_iter().rev() {
            first = first.or(pollster::block_on(scope.pop()));
        }
        let stray = self.uncaptured.lock().ok().and_then(|mut slot| slot.take());
        if self.lost.load(Ordering::Relaxed) {
            return Err(GpuError::Lost(doing.to_owned()));
        }
        match first.or(stray) {
            None => Ok(result),
            Some(error) => Err(GpuError::from_wgpu(error, doing)),
        }
    }

    /// Waits for all submitted work.
    pub(super) fn wait(&self, doing: &str) -> Result<(), GpuError> {
        let waited =
            self.device.poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(WAIT) });
        if self.lost.load(Ordering::Relaxed) {
            return Err(GpuError::Lost(doing.to_owned()));
        }
        match waited {
            Ok(_) => Ok(()),
            Err(wgpu::PollError::Timeout) => {
                Err(GpuError::Timeout { what: doing.to_owned(), seconds: WAIT.as_secs() })
            }
            Err(error) => Err(GpuError::Invalid(format!("{doing}: {error}"))),
        }
    }
}
