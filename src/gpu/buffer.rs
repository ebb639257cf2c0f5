//! Buffers: made within the adapter's limits, filled, and read back.

use bytemuck::Pod;

use super::{Gpu, GpuError};

impl Gpu {
    /// A storage buffer of `count` zeroed elements of `T` (at least one, as an empty binding
    /// is not allowed).
    ///
    /// # Errors
    /// It is larger than the adapter binds, or memory is out.
    pub fn storage<T: Pod>(&self, label: &str, count: usize) -> Result<wgpu::Buffer, GpuError> {
        let size = (count.max(1) as u64).saturating_mul(size_of::<T>() as u64);
        self.check_binding(label, size)?;
        self.checked(&format!("allocating {label}"), || {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::STORAGE
                    | wgpu::BufferUsages::COPY_DST
                    | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        })
    }

    /// A storage buffer that holds `data`.
    ///
    /// # Errors
    /// As [`Gpu::storage`].
    pub fn storage_of<T: Pod>(&self, label: &str, data: &[T]) -> Result<wgpu::Buffer, GpuError> {
        let buffer = self.storage::<T>(label, data.len())?;
        if !data.is_empty() {
            self.write(&buffer, data)?;
        }
        Ok(buffer)
    }

    /// A buffer for the parameters of a kernel, one `T`. It is a storage buffer, as Mesa's lavapipe
    /// compiles a shader anew for all values of uniforms that loops or branches depend on.
    ///
    /// # Errors
    /// Memory is out.
    pub fn parameters<T: Pod>(&self, label: &str) -> Result<wgpu::Buffer, GpuError> {
        self.checked(&format!("allocating {label}"), || {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size_of::<T>() as u64,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })
    }

    /// Fills the head of a buffer, before the next submission.
    ///
    /// # Errors
    /// Memory is out, or `data` is longer than the buffer.
    pub fn write<T: Pod>(&self, buffer: &wgpu::Buffer, data: &[T]) -> Result<(), GpuError> {
        self.checked("uploading", || {
            self.queue.write_buffer(buffer, 0, bytemuck::cast_slice(data));
        })
    }

    /// Copies the first `count` elements of a storage buffer to the host, and waits.
    ///
    /// # Errors
    /// The device fails or does not answer.
    pub fn read<T: Pod>(&self, buffer: &wgpu::Buffer, count: usize) -> Result<Vec<T>, GpuError> {
        let size = (count * size_of::<T>()) as u64;
        if size == 0 {
            return Ok(Vec::new());
        }
        let (staging, mapped) = self.checked("reading back", || {
            let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("read-back"),
                size,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            let mut encoder = self.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, size);
            self.queue.submit([encoder.finish()]);
            let (sender, mapped) = futures_intrusive::channel::shared::oneshot_channel();
            staging.map_async(wgpu::MapMode::Read, .., move |result| {
                // The receiver is gone only if waiting below has failed already.
                let _ = sender.send(result);
            });
            (staging, mapped)
        })?;
        self.wait("reading back")?;
        match pollster::block_on(mapped.receive()) {
            Some(Ok(())) => {}
            _ => return Err(GpuError::Lost("reading back".to_owned())),
        }
        let view = staging
            .get_mapped_range(..)
            .map_err(|error| GpuError::Invalid(format!("reading back: {error}")))?;
        let data = bytemuck::pod_collect_to_vec(&view);
        drop(view);
        staging.unmap();
        Ok(data)
    }

    /// Whether so many bytes are left, where the device's memory is the host's and the host tells.
    ///
    /// # Errors
    /// They are not.
    pub fn check_memory(&self, what: &str, needed: u64) -> Result<(), GpuError> {
        let software = self.info.device_type == "cpu";
        match available_memory().filter(|_| software) {
            Some(available) if needed > available => {
                Err(GpuError::Memory { what: what.to_owned(), needed, available })
            }
            _ => Ok(()),
        }
    }

    /// Whether the adapter binds a buffer of so many bytes.
    ///
    /// # Errors
    /// It does not.
    pub fn check_binding(&self, label: &str, needed: u64) -> Result<(), GpuError> {
        let limits = self.limits();
        let available = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if needed > available {
            return Err(GpuError::Limit {
                what: format!("the buffer of {label}"),
                needed,
                available,
                advice: "use a smaller scene or fewer VPLs, or an adapter with larger bindings",
            });
        }
        Ok(())
    }
}

/// What the host could give without swapping, where Linux's /proc tells it.
fn available_memory() -> Option<u64> {
    let info = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = info.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}
