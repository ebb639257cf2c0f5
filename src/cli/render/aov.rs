//! Images beside the frame's own.

use crate::render::Method;

/// An auxiliary image (arbitrary output variable).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aov {
    /// What another method shows.
    Of(Method),
    /// The standard error of each pixel, of the frame itself.
    StandardError,
}

impl Aov {
    /// The name on the command line, in layers and in file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Of(method) => method.name(),
            Self::StandardError => "standard-error",
        }
    }
}
