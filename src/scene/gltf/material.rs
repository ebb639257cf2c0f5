//! Metal-roughness materials, as the nearest there is: diffuse.

use glam::DVec3;

use super::json;
use super::source::Source;
use crate::error::SceneError;
use crate::scene::{DraftMaterial, Origin, Warning};

const STRENGTH: &str = "KHR_materials_emissive_strength";

/// Writers round colours to f32: this much above 1 is 1.
const ROUNDING: f64 = 1e-6;

/// The nearest material that can be rendered, and what was lost on the way.
///
/// The albedo is the base colour: of what is no metal, its diffuse part; of a metal, what it
/// mirrors, shown as diffuse. The 4 % that glTF lets everything else mirror are left out.
pub fn to_draft(
    source: &Source,
    index: usize,
) -> Result<(DraftMaterial, Option<Warning>), SceneError> {
    let material = source.item(&source.document.materials, "material", index)?;
    let name = name(source, index);
    let pbr = &material.pbr_metallic_roughness;
    let [r, g, b, _] = pbr.base_color_factor.unwrap_or([1.0; 4]);
    let rounded = |x: f64| if x > 1.0 && x <= 1.0 + ROUNDING { 1.0 } else { x };
    let emission = DVec3::from_array(material.emissive_factor.unwrap_or_default());
    let draft = DraftMaterial {
        albedo: DVec3::new(r, g, b).map(rounded),
        emission: emission * strength(source, &name, material)?,
        two_sided: material.double_sided,
        origin: Origin::file(&source.path),
        name,
        ..DraftMaterial::default()
    };
    let left_out = left_out(source, material);
    let warning = (!left_out.is_empty()).then(|| {
        let what = left_out.join(", ");
        Warning::changed(source.says(&format!(
            "material `{}` has {what}, not supported yet; shown as diffuse, of its factors alone",
            draft.name
        )))
    });
    Ok((draft, warning))
}

/// A material's name, or one made of its index.
pub fn name(source: &Source, index: usize) -> String {
    let name = source.document.materials.get(index).and_then(|material| material.name.clone());
    name.filter(|name| !name.is_empty()).unwrap_or_else(|| format!("material {index}"))
}

fn strength(source: &Source, name: &str, material: &json::Material) -> Result<f64, SceneError> {
    let Some(extension) = material.extensions.get(STRENGTH) else { return Ok(1.0) };
    let Some(strength) = extension.get("emissiveStrength") else { return Ok(1.0) };
    strength.as_f64().ok_or_else(|| {
        source.fault(format!("material `{name}`: emissiveStrength is no number; export it again"))
    })
}

/// What of it is not rendered. Occlusion is: light finds its own.
fn left_out(source: &Source, material: &json::Material) -> Vec<String> {
    let pbr = &material.pbr_metallic_roughness;
    let mut parts = Vec::new();
    if pbr.metallic_factor.unwrap_or(1.0) > 0.0 {
        parts.push("a metallic surface".to_owned());
    }
    if material.alpha_mode.as_deref().is_some_and(|mode| mode != "OPAQUE") {
        parts.push("transparency".to_owned());
    }
    let textures = [
        ("baseColorTexture", &pbr.base_color_texture),
        ("metallicRoughnessTexture", &pbr.metallic_roughness_texture),
        ("normalTexture", &material.normal_texture),
        ("emissiveTexture", &material.emissive_texture),
    ];
    for (kind, texture) in textures {
        let Some(texture) = texture else { continue };
        parts.push(format!("{kind} `{}`", texture_name(source, texture.index)));
    }
    parts.extend(material.extensions.keys().filter(|name| *name != STRENGTH).cloned());
    parts
}

/// An image's name or file; a texture's number if it has none.
fn texture_name(source: &Source, texture: usize) -> String {
    let document = &source.document;
    let image = document.textures.get(texture).and_then(|texture| texture.source);
    let image = image.and_then(|image| document.images.get(image));
    // A data URI is no name.
    let uri = |image: &json::Image| image.uri.clone().filter(|uri| !uri.starts_with("data:"));
    let name = image.and_then(|image| uri(image).or_else(|| image.name.clone()));
    name.unwrap_or_else(|| format!("texture {texture}"))
}
