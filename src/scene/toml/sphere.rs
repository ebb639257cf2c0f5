//! The `[[sphere]]` tables.

use std::collections::HashMap;

use super::material;
use crate::scene::document::Section;
use crate::scene::{Draft, DraftSphere, SceneError};

/// Reads a sphere.
pub fn read(
    section: &Section,
    materials: &HashMap<String, u32>,
    draft: &mut Draft,
) -> Result<(), SceneError> {
    section.only(&["center", "radius", "material"])?;
    let center = section.required("center")?.vector()?;
    let radius = section.required("radius")?.length()?;
    let material = material::named(&section.required("material")?, materials)?;
    draft.spheres.push(DraftSphere { center, radius, material });
    Ok(())
}
