//! Wavefront OBJ and MTL.

use std::path::Path;

use super::Scene;
use crate::error::SceneError;

/// Loads a mesh without a scene file: framed automatically.
pub fn load_bare(path: &Path) -> Result<Scene, SceneError> {
    Err(SceneError::new(path, "not written"))
}
