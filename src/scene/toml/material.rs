//! The `[materials.NAME]` tables.

use glam::DVec3;

use crate::scene::document::{Section, Value};
use crate::scene::{Bsdf, Draft, DraftMaterial, SceneError, normalise};

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Diffuse,
    Phong,
    Mirror,
    Glass,
}

const KINDS: [(&str, Kind); 4] = [
    ("diffuse", Kind::Diffuse),
    ("phong", Kind::Phong),
    ("mirror", Kind::Mirror),
    ("glass", Kind::Glass),
];

impl Kind {
    /// The keys beside those that all have.
    fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Diffuse => &["albedo", "texture"],
            Self::Phong => &["albedo", "texture", "specular", "shininess"],
            Self::Mirror => &["specular"],
            Self::Glass => &["ior", "specular"],
        }
    }
}

/// Reads a material and its texture, which multiplies the albedo.
pub fn read(name: &str, section: &Section, draft: &mut Draft) -> Result<DraftMaterial, SceneError> {
    let kind = section.get("type").map_or(Ok(Kind::Diffuse), |kind| kind.choice(&KINDS))?;
    let written = KINDS.iter().find(|(_, other)| *other == kind).map_or("", |(name, _)| name);
    let keys = [&["type", "emission", "two_sided"], kind.keys()].concat();
    let section = section.only_as(format!("[materials.{name}] of type {written:?}"), &keys)?;
    let emission = section.get("emission").map(|emission| emission.power()).transpose()?;
    let specular = section.get("specular").map(|specular| reflectance(&specular)).transpose()?;
    let rounded = normalise::round(specular.unwrap_or(DVec3::ONE));
    let bsdf = match kind {
        Kind::Diffuse => Bsdf::Diffuse,
        Kind::Phong => {
            section.required("specular")?;
            let shininess = section.required("shininess")?;
            Bsdf::Phong { specular: rounded, shininess: within(&shininess, 0.0, 1e6)? as f32 }
        }
        Kind::Mirror => Bsdf::Mirror { specular: rounded },
        Kind::Glass => {
            let ior = section.get("ior").map_or(Ok(1.5), |ior| within(&ior, 0.1, 10.0))?;
            Bsdf::Glass { specular: rounded, ior: ior as f32 }
        }
    };
    let albedo = match section.get("albedo") {
        Some(albedo) => reflectance(&albedo)?,
        // What a highlight leaves, of a texture alone.
        None if section.get("texture").is_some() => DVec3::ONE - specular.unwrap_or_default(),
        None if emission.is_some() || bsdf.is_specular() => DVec3::ZERO,
        None => return Err(section.fault("key `albedo` is missing; give it, or a `texture`")),
    };
    Ok(DraftMaterial {
        name: name.to_owned(),
        albedo,
        texture: section.get("texture").map(|value| texture(&value, draft)).transpose()?,
        bsdf,
        emission: emission.unwrap_or_default(),
        two_sided: section.get("two_sided").map_or(Ok(false), |value| value.boolean())?,
        origin: section.origin(),
        ..DraftMaterial::default()
    })
}

/// The index of a material that must be one of `[materials]`.
pub fn named(
    value: &Value,
    materials: &std::collections::HashMap<String, u32>,
) -> Result<u32, SceneError> {
    let name = value.string()?;
    let what = || value.fault(&format!("names no material: `{name}` is not in [materials]"));
    materials.get(name).copied().ok_or_else(what)
}

fn texture(value: &Value, draft: &mut Draft) -> Result<u32, SceneError> {
    let origin = value.origin();
    let path = value.path(&mut draft.warnings)?;
    Ok(draft.texture_file(&path, &origin))
}

fn reflectance(value: &Value) -> Result<DVec3, SceneError> {
    let reflectance = value.vector()?;
    match reflectance.min_element() >= 0.0 && reflectance.max_element() <= 1.0 {
        true => Ok(reflectance),
        false => Err(value.fault("must lie within 0 and 1")),
    }
}

fn within(value: &Value, least: f64, most: f64) -> Result<f64, SceneError> {
    let number = value.number()?;
    match (least..=most).contains(&number) {
        true => Ok(number),
        false => Err(value.fault(&format!("must lie within {least} and {most}"))),
    }
}
