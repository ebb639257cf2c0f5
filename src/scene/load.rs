//! Reading a scene of any format: the name tells which.

use std::path::Path;

use super::{Scene, SceneError, builtin, gltf, obj, toml};

impl Scene {
    /// Reads a scene: `builtin:NAME`, a `.toml` scene file, a glTF file or a bare `.obj`.
    ///
    /// # Errors
    /// The file is missing, malformed, or names something that is not supported.
    pub fn load(source: &str) -> Result<Self, SceneError> {
        if let Some(name) = source.strip_prefix("builtin:") {
            return builtin::load(name);
        }
        let path = Path::new(source);
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("toml") => toml::load(path),
            Some("obj") => obj::load_bare(path),
            Some("gltf" | "glb") => gltf::load_bare(path),
            _ => Err(SceneError::new(
                path,
                "unknown kind of scene; give a .toml scene file, an .obj, .gltf, .glb or builtin:NAME",
            )),
        }
    }
}
