//! The adapters and built-in scenes there are, in words.

use std::fmt::{Result, Write};

use super::listing::{Builtin, Info};
use crate::gpu::{AdapterDescription, AdapterInfo};

/// All adapters with their limits, and all built-in scenes.
pub fn in_words(text: &mut String, info: &Info) -> Result {
    writeln!(text, "gpu-vpl {}\n\nadapters:", info.version)?;
    for (index, AdapterDescription { info, limits, features }) in info.adapters.iter().enumerate() {
        let AdapterInfo { name, backend, driver, device_type } = info;
        writeln!(text, "  {index}: {name} ({backend}, {driver}, {device_type})")?;
        for (limit, value) in limits {
            writeln!(text, "       {limit}: {value}")?;
        }
        if !features.is_empty() {
            writeln!(text, "       features: {}", features.join(", "))?;
        }
    }
    chosen_in_words(text, info)?;
    writeln!(text, "\nbuilt-in scenes:")?;
    for Builtin { name, what } in &info.builtin_scenes {
        writeln!(text, "  {name:24} {what}")?;
    }
    Ok(())
}

/// The adapter that `render` would take, or that there is none.
pub fn chosen_in_words(text: &mut String, info: &Info) -> Result {
    match (&info.chosen, &info.chosen_error) {
        (Some(chosen), _) => writeln!(text, "chosen: {} ({})", chosen.name, chosen.backend),
        (None, reason) => writeln!(text, "chosen: none; {}", reason.as_deref().unwrap_or("")),
    }
}
