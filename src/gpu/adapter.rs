//! Which adapter renders. Apart from rendering: everything else is given an open device.

use super::GpuError;

/// How to choose an adapter.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum AdapterChoice {
    /// Hardware first, software as the fallback.
    Auto,
    /// An index of [`adapters`], or part of a name or driver in any case; `lavapipe`, `cpu`
    /// and `software` mean the software one.
    Named(String),
}

/// An adapter, in words.
#[derive(Debug, Clone, Default, PartialEq, Eq, serde::Serialize)]
pub struct AdapterInfo {
    /// Its name.
    pub name: String,
    /// `vulkan`, `metal` or `dx12`.
    pub backend: String,
    /// Driver and version.
    pub driver: String,
    /// `discrete`, `integrated`, `virtual`, `cpu` or `other`.
    pub device_type: String,
}

/// One adapter as `info` shows it: its words, and its limits as (name, value) rows.
#[derive(Debug, Clone, serde::Serialize)]
pub struct AdapterDescription {
    /// Its words.
    #[serde(flatten)]
    pub info: AdapterInfo,
    /// The limits that bound a render, by name.
    pub limits: Vec<(&'static str, u64)>,
    /// The optional features that are used where present.
    pub features: Vec<&'static str>,
}

/// All adapters of this machine, in the order in which [`AdapterChoice::Auto`] tries them.
pub fn adapters() -> Vec<AdapterDescription> {
    enumerate().unwrap_or_default().iter().map(describe_fully).collect()
}

/// The adapter that a choice means.
pub(super) fn choose(choice: &AdapterChoice) -> Result<wgpu::Adapter, GpuError> {
    let mut found = enumerate()?;
    if found.is_empty() {
        return Err(GpuError::NoAdapter);
    }
    let index = match choice {
        AdapterChoice::Auto => Some(0),
        AdapterChoice::Named(wanted) => {
            let infos: Vec<_> = found.iter().map(|a| describe(&a.get_info())).collect();
            find(&infos, wanted)
        }
    };
    match (index, choice) {
        (Some(index), _) => Ok(found.swap_remove(index)),
        (None, AdapterChoice::Named(wanted)) => Err(GpuError::NoSuchAdapter {
            wanted: wanted.clone(),
            found: found.iter().map(|a| a.get_info().name).collect::<Vec<_>>().join(", "),
        }),
        (None, AdapterChoice::Auto) => Err(GpuError::NoAdapter),
    }
}

/// The optional features we use where an adapter has them.
pub(super) fn useful_features(adapter: &wgpu::Adapter) -> wgpu::Features {
    adapter.features() & (wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::SUBGROUP)
}

/// An adapter in words.
pub(super) fn describe(info: &wgpu::AdapterInfo) -> AdapterInfo {
    let device_type = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete",
        wgpu::DeviceType::IntegratedGpu => "integrated",
        wgpu::DeviceType::VirtualGpu => "virtual",
        wgpu::DeviceType::Cpu => "cpu",
        wgpu::DeviceType::Other => "other",
    };
    AdapterInfo {
        name: info.name.clone(),
        backend: info.backend.to_str().to_owned(),
        driver: format!("{} {}", info.driver, info.driver_info).trim().to_owned(),
        device_type: device_type.to_owned(),
    }
}

fn find(adapters: &[AdapterInfo], wanted: &str) -> Option<usize> {
    if let Ok(index) = wanted.parse::<usize>() {
        return (index < adapters.len()).then_some(index);
    }
    let wanted = wanted.to_lowercase();
    if ["lavapipe", "cpu", "software"].contains(&wanted.as_str()) {
        return adapters.iter().position(|a| a.device_type == "cpu");
    }
    adapters.iter().position(|a| {
        !wanted.is_empty()
            && (a.name.to_lowercase().contains(&wanted)
                || a.driver.to_lowercase().contains(&wanted))
    })
}

/// The variable that names backends, as for other programs of wgpu.
const BACKENDS: &str = "WGPU_BACKEND";

/// The backends that a comma-separated list asks for: of those this program has, and all of them where it
/// names none.
fn backends(list: &str) -> Result<wgpu::Backends, GpuError> {
    let mut backends = wgpu::Backends::empty();
    let names = || list.split(',').map(str::trim).filter(|name| !name.is_empty());
    for name in names() {
        backends |= match name.to_ascii_lowercase().as_str() {
            "vulkan" | "vk" => wgpu::Backends::VULKAN,
            "metal" | "mtl" => wgpu::Backends::METAL,
            "dx12" | "d3d12" => wgpu::Backends::DX12,
            "primary" => wgpu::Backends::PRIMARY,
            // Others may be met by what else the list has.
            "gl" | "gles" | "opengl" | "webgpu" | "dx11" | "d3d11" => continue,
            _ => return Err(GpuError::NoSuchBackend(list.to_owned())),
        };
    }
    match names().next() {
        None => Ok(wgpu::Backends::PRIMARY),
        Some(_) if backends.is_empty() => Err(GpuError::NoSuchBackend(list.to_owned())),
        Some(_) => Ok(backends),
    }
}

/// All adapters, best first; the order among equals is the driver's.
fn enumerate() -> Result<Vec<wgpu::Adapter>, GpuError> {
    let list = std::env::var(BACKENDS).unwrap_or_default();
    let wanted = backends(&list)?;
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    // The driver's validation layers are a debugging aid that changes timings.
    descriptor.flags = wgpu::InstanceFlags::empty();
    descriptor.backends = wanted;
    let instance = wgpu::Instance::new(descriptor);
    let mut found = pollster::block_on(instance.enumerate_adapters(wanted));
    found.sort_by_key(|adapter| match adapter.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    });
    if found.is_empty() && !list.trim().is_empty() {
        return Err(GpuError::NoSuchBackend(list));
    }
    Ok(found)
}

fn describe_fully(adapter: &wgpu::Adapter) -> AdapterDescription {
    let limits = adapter.limits();
    let info = adapter.get_info();
    let features = adapter.features();
    let mut names = Vec::new();
    if features.contains(wgpu::Features::TIMESTAMP_QUERY) {
        names.push("timestamps");
    }
    if features.contains(wgpu::Features::SUBGROUP) {
        names.push("subgroups");
    }
    AdapterDescription {
        info: describe(&info),
        limits: vec![
            ("storage binding bytes", limits.max_storage_buffer_binding_size),
            ("buffer bytes", limits.max_buffer_size),
            ("storage buffers a stage", u64::from(limits.max_storage_buffers_per_shader_stage)),
            ("workgroups a dimension", u64::from(limits.max_compute_workgroups_per_dimension)),
            ("invocations a workgroup", u64::from(limits.max_compute_invocations_per_workgroup)),
            ("subgroup lanes, least", u64::from(info.subgroup_min_size)),
            ("subgroup lanes, most", u64::from(info.subgroup_max_size)),
        ],
        features: names,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adapter(name: &str, driver: &str, device_type: &str) -> AdapterInfo {
        AdapterInfo {
            name: name.into(),
            backend: "vulkan".into(),
            driver: driver.into(),
            device_type: device_type.into(),
        }
    }

    #[test]
    fn backends_are_those_asked_for() {
        let of = |list: &str| backends(list).ok();
        assert_eq!(of(""), Some(wgpu::Backends::PRIMARY));
        assert_eq!(of("Vulkan"), Some(wgpu::Backends::VULKAN));
        assert_eq!(of("gl, vk"), Some(wgpu::Backends::VULKAN));
        for list in ["gl", "voodoo", "vulkan,voodoo"] {
            assert_eq!(of(list), None, "{list}");
        }
    }

    #[test]
    fn adapters_are_found_by_index_name_driver_and_kind() {
        let found = [
            adapter("Great GPU 9000", "greatdrv 1.2", "discrete"),
            adapter("llvmpipe (LLVM 15)", "llvmpipe Mesa 22", "cpu"),
        ];
        assert_eq!(find(&found, "1"), Some(1));
        assert_eq!(find(&found, "2"), None);
        assert_eq!(find(&found, "gREAT"), Some(0));
        assert_eq!(find(&found, "mesa"), Some(1));
        assert_eq!(find(&found, "software"), Some(1));
        assert_eq!(find(&found, "CPU"), Some(1));
        assert_eq!(find(&found, "voodoo"), None);
        assert_eq!(find(&found, ""), None);
    }
}
