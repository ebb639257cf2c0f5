//! Scenes made by the program.

use super::Scene;
use crate::error::SceneError;

/// Names of the built-in scenes, and what they are.
pub const BUILTIN_SCENES: &[(&str, &str)] = &[("cornell", "the Cornell box, area light")];

/// Makes the built-in scene of this name.
pub fn load(name: &str) -> Result<Scene, SceneError> {
    Err(SceneError::new(name, "not written"))
}
