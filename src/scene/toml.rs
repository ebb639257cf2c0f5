//! The scene file.

use std::path::Path;

use super::Scene;
use crate::error::SceneError;

/// Loads a scene file.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    Err(SceneError::new(path, "not written"))
}
