//! Text files, as people write them.

use std::path::Path;

use super::SceneError;

/// Reads a file as text: bytes that are no UTF-8 are replaced, lines end in '\n'.
pub fn read_text(file: &Path) -> Result<String, SceneError> {
    let bytes = std::fs::read(file).map_err(|error| {
        SceneError::new(file, format!("cannot read it: {error}; check the name and its rights"))
    })?;
    let text = String::from_utf8_lossy(&bytes);
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    Ok(text.replace("\r\n", "\n").replace('\r', "\n"))
}
