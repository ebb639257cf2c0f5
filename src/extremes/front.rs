//! How the options of cases are read.

use crate::error::Error;
use crate::render::Settings;

/// What options of `render` ask for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// How to render.
    pub settings: Settings,
    /// Of all random numbers.
    pub seed: u32,
    /// Width and height; the scene's if there is none.
    pub size: Option<[u32; 2]>,
}

/// The command line, which is above this module: how it reads options.
#[derive(Debug, Clone, Copy)]
pub struct Front {
    /// What words ask for, or why they are refused.
    pub options: fn(&[String]) -> Result<Asked, Error>,
}
