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
    /// From its name.
    ///
    /// # Errors
    /// It is none.
    pub fn parse(text: &str) -> Result<Self, String> {
        let data = [Method::Normal, Method::Albedo, Method::Depth].map(Self::Of);
        let found = data.into_iter().chain([Self::StandardError]).find(|aov| aov.name() == text);
        found.ok_or_else(|| "give some of normal,albedo,depth,standard-error".to_owned())
    }

    /// The name on the command line, in layers and in file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Of(method) => method.name(),
            Self::StandardError => "standard-error",
        }
    }
}
