//! The `[materials.NAME]` tables.

use glam::DVec3;

use crate::error::SceneError;
use crate::scene::DraftMaterial;
use crate::scene::document::Section;

/// Reads a material.
pub fn read(name: &str, section: &Section) -> Result<DraftMaterial, SceneError> {
    if let Some(kind) = section.get("type") {
        let supported = [("diffuse", true), ("phong", false), ("mirror", false), ("glass", false)];
        if !kind.choice(&supported)? {
            let what = format!("{:?} is not supported yet; use \"diffuse\"", kind.string()?);
            return Err(kind.fault(&what));
        }
    }
    if let Some(texture) = section.get("texture") {
        return Err(texture.fault("is not supported yet; give an albedo"));
    }
    section.only(&["type", "albedo", "emission", "two_sided"])?;
    let emission = section.get("emission").map(|emission| emission.power()).transpose()?;
    let albedo = match section.get("albedo") {
        None if emission.is_some() => DVec3::ZERO,
        None => return Err(section.fault("key `albedo` is missing")),
        Some(value) => {
            let albedo = value.vector()?;
            if albedo.min_element() < 0.0 || albedo.max_element() > 1.0 {
                return Err(value.fault("must lie within 0 and 1"));
            }
            albedo
        }
    };
    Ok(DraftMaterial {
        name: name.to_owned(),
        albedo,
        emission: emission.unwrap_or_default(),
        two_sided: section.get("two_sided").map_or(Ok(false), |value| value.boolean())?,
        origin: section.origin(),
        ..DraftMaterial::default()
    })
}
