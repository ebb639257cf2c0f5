//! Why an image is not denoised.

use crate::render::RenderError;

/// Why an image is not denoised: one line.
#[derive(Debug, thiserror::Error)]
pub enum DenoiseError {
    /// These settings leave nothing that may be denoised.
    #[error("--denoise {0}")]
    Refused(String),
    /// There is no library, or none that can be used.
    #[error(
        "--denoise needs the library of Open Image Denoise 2: {0}; install it \
         (www.openimagedenoise.org, or pip install pyoidn) and name its file or folder in {name}",
        name = super::places::VARIABLE
    )]
    Missing(String),
    /// The library failed.
    #[error("Open Image Denoise: {0}")]
    Failed(String),
    /// What was to be denoised cannot be rendered.
    #[error(transparent)]
    Render(#[from] RenderError),
}
