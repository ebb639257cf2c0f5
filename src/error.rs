//! What can go wrong: [`Error`] joins the errors of all rooms and knows the exit code.

use crate::denoise::DenoiseError;
use crate::gpu::GpuError;
pub use crate::image::{ImageError, OutputError};
use crate::render::{RenderError, SettingsError};
pub use crate::scene::SceneError;

/// Everything that ends a command early.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The command line asks for something that cannot be done.
    #[error("{0}")]
    Usage(String),
    /// The scene cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An image cannot be read.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The device cannot be used, or failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The denoiser failed.
    #[error("{0}")]
    Denoise(String),
    /// The result cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Figures of a study are not what they must be.
    #[error("{0}")]
    Wrong(String),
    /// The user asked to stop.
    #[error("{0}")]
    Interrupted(String),
    /// `--strict` and the image is not what was asked for.
    #[error("{0}")]
    Strict(String),
    /// Images differ by more than a limit allows.
    #[error("{0}")]
    OverLimit(String),
}

impl Error {
    /// The process's exit code: 1 failed while running, 2 usage or an unreadable scene or
    /// image, 3 no usable adapter, 4 over a limit, 130 interrupted.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_)
            | Self::Scene(_)
            | Self::Image(_)
            | Self::Output(OutputError::UnknownFormat(_)) => 2,
            Self::Gpu(error) if error.is_missing_adapter() => 3,
            Self::Gpu(_)
            | Self::Denoise(_)
            | Self::Output(_)
            | Self::Strict(_)
            | Self::Wrong(_) => 1,
            Self::OverLimit(_) => 4,
            Self::Interrupted(_) => 130,
        }
    }
}

impl From<RenderError> for Error {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Settings(refused) => refused.into(),
            RenderError::Gpu(failed) => failed.into(),
        }
    }
}

impl From<DenoiseError> for Error {
    fn from(error: DenoiseError) -> Self {
        match error {
            DenoiseError::Render(failed) => failed.into(),
            DenoiseError::Failed(_) => Self::Denoise(error.to_string()),
            DenoiseError::Refused(_) | DenoiseError::Missing(_) => Self::Usage(error.to_string()),
        }
    }
}

impl From<SettingsError> for Error {
    fn from(refusal: SettingsError) -> Self {
        Self::Usage(refusal.to_string())
    }
}
