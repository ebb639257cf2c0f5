//! What can go wrong with the device.

/// What can go wrong with the device.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter at all.
    #[error(
        "no Vulkan, Metal or DirectX 12 adapter found; on Debian or Ubuntu install one with: \
         apt-get install mesa-vulkan-drivers"
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
    /// None of the backends that the environment asks for.
    #[error(
        "WGPU_BACKEND={0} leaves no adapter: there are the backends vulkan, metal and dx12, as far as \
         the system has them; unset it, or name one of these"
    )]
    NoSuchBackend(String),
    /// The adapter is there but gives no device.
    #[error("cannot open adapter {name}: {why}")]
    CannotOpen {
        /// The adapter.
        name: String,
        /// The driver's reason.
        why: String,
    },
    /// The adapter's limits do not allow it.
    #[error("{what} needs {needed} bytes, the adapter allows {available}; {advice}")]
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
    /// The host, whose memory a software device uses, has not so much.
    #[error("{what} needs {needed} bytes of memory, {available} are left; use a smaller scene")]
    Memory {
        /// What is too large.
        what: String,
        /// How much it needs.
        needed: u64,
        /// How much there is.
        available: u64,
    },
    /// The device has no memory left.
    #[error("out of device memory while {0}; render a smaller scene or fewer VPLs")]
    OutOfMemory(String),
    /// The host has no memory for the result.
    #[error(
        "an image of {width} x {height} pixels needs {bytes} bytes of memory; ask for a smaller one"
    )]
    ImageTooLarge {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// How much it needs.
        bytes: u64,
    },
    /// The device went away.
    #[error("the device was lost while {0}; try again, or another --adapter")]
    Lost(String),
    /// The device did not finish in time.
    #[error("the device did not finish {what} within {seconds} s; try another --adapter")]
    Timeout {
        /// What it was doing.
        what: String,
        /// How long we waited.
        seconds: u64,
    },
    /// The user asked to stop.
    #[error("interrupted")]
    Interrupted,
    /// A driver that bounds the rounds of a shader's loops left one before its end.
    #[error(
        "the driver cuts the loop of a single shadow ray short: the scene is too large for it; try another --adapter"
    )]
    LoopCut,
    /// A shader or a call that the device refuses: a fault of this program.
    #[error("internal error, please report it: {0}")]
    Invalid(String),
}

impl GpuError {
    /// Whether there was no adapter to use, as against one that failed.
    pub fn is_missing_adapter(&self) -> bool {
        matches!(
            self,
            Self::NoAdapter
                | Self::NoSuchAdapter { .. }
                | Self::NoSuchBackend(_)
                | Self::CannotOpen { .. }
        )
    }

    /// Our error for one of wgpu's.
    pub(super) fn from_wgpu(error: wgpu::Error, doing: &str) -> Self {
        match error {
            wgpu::Error::OutOfMemory { .. } => Self::OutOfMemory(doing.to_owned()),
            wgpu::Error::Validation { description, .. }
            | wgpu::Error::Internal { description, .. } => {
                let line = description.split_whitespace().collect::<Vec<_>>().join(" ");
                Self::Invalid(format!("{doing}: {line}"))
            }
        }
    }
}
