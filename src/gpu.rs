//! The device: adapter choice, limits, buffers, kernels and passes. Knows nothing of scenes.

/// What can go wrong with the device.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter at all.
    #[error(
        "no Vulkan, Metal or DirectX 12 adapter found; on Debian or Ubuntu install a driver with: apt-get install mesa-vulkan-drivers (software rendering)"
    )]
    NoAdapter,
    /// None that matches.
    #[error("no adapter matches '{wanted}'; there are: {found}")]
    NoSuchAdapter {
        /// What was asked for.
        wanted: String,
        /// The adapters there are.
        found: String,
    },
    /// The adapter's limits do not allow it.
    #[error("{what} needs {needed}, the adapter allows {available}; {advice}")]
    Limit {
        /// What is too large.
        what: String,
        /// How much it needs.
        needed: u64,
        /// How much there is.
        available: u64,
        /// What to do.
        advice: &'static str,
    },
    /// The device has no memory left.
    #[error("out of device memory while {0}; render a smaller image or fewer VPLs")]
    OutOfMemory(String),
    /// The device went away.
    #[error("the device was lost while {0}")]
    Lost(String),
    /// The device did not finish in time.
    #[error("the device did not finish {what} within {seconds} s")]
    Timeout {
        /// What it was doing.
        what: String,
        /// How long we waited.
        seconds: u64,
    },
    /// A shader or a call that the device refuses: a fault of this program.
    #[error("internal error: {0}")]
    Invalid(String),
}

impl GpuError {
    /// Whether there was no adapter to use, as against one that failed.
    pub fn is_missing_adapter(&self) -> bool {
        matches!(self, Self::NoAdapter | Self::NoSuchAdapter { .. })
    }
}

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
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
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
    Vec::new()
}

/// An open device.
#[derive(Debug)]
pub struct Gpu {
    /// What it is.
    pub info: AdapterInfo,
}

impl Gpu {
    /// Opens the adapter chosen.
    ///
    /// # Errors
    /// There is none, none of that name, or it cannot be opened.
    pub fn open(choice: &AdapterChoice) -> Result<Self, GpuError> {
        let _ = choice;
        Err(GpuError::NoAdapter)
    }
}
