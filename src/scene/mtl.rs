//! Wavefront MTL, read line by line: what of it is not shown is reported with its line, which
//! `tobj`'s reader does not keep.

mod map;
mod surface;

use std::path::{Path, PathBuf};

use glam::DVec3;

use super::obj::read_text;
use crate::error::SceneError;
use map::Map;

/// Albedo of what has no material, or a material without colour.
pub const DEFAULT_ALBEDO: DVec3 = DVec3::splat(0.8);

/// A material as the file gives it; colours are linear.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MtlMaterial {
    /// Its name.
    pub name: String,
    file: PathBuf,
    line: usize,
    diffuse: Option<DVec3>,
    specular: DVec3,
    emission: Option<DVec3>,
    shininess: f64,
    dissolve: Option<f64>,
    transparency: f64,
    illumination: f64,
    refraction: Option<f64>,
    transmission: Option<DVec3>,
    diffuse_map: Option<Map>,
    opacity_map: Option<Map>,
    emission_map: Option<Map>,
    /// Statements of maps that are not shown.
    other_maps: Vec<String>,
}

/// Reads all materials of a file; of two of one name, the first.
pub fn read(file: &Path) -> Result<Vec<MtlMaterial>, SceneError> {
    parse(file, &read_text(file)?)
}

fn parse(file: &Path, text: &str) -> Result<Vec<MtlMaterial>, SceneError> {
    let mut materials: Vec<MtlMaterial> = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let mut words = content.split_whitespace().take_while(|word| !word.starts_with('#'));
        let Some(keyword) = words.next() else { continue };
        let statement = Statement { file, line, keyword, words: words.collect(), content };
        if keyword.eq_ignore_ascii_case("newmtl") {
            // A name may hold blanks and '#'.
            let name = content.trim_start()[keyword.len()..].trim().to_owned();
            let file = file.to_owned();
            materials.push(MtlMaterial { name, file, line, ..MtlMaterial::default() });
        } else if let Some(material) = materials.last_mut() {
            statement.apply(material)?;
        } else if statement.is_colour() {
            return Err(SceneError::at(file, line, format!("{keyword} before any newmtl")));
        }
    }
    Ok(materials)
}

/// A line of the file.
struct Statement<'a> {
    file: &'a Path,
    line: usize,
    keyword: &'a str,
    words: Vec<&'a str>,
    /// The whole line.
    content: &'a str,
}

impl Statement<'_> {
    fn is_colour(&self) -> bool {
        ["kd", "ks", "ke"].contains(&self.lowercase().as_str())
    }

    fn lowercase(&self) -> String {
        self.keyword.to_ascii_lowercase()
    }

    /// Notes what it says of a material. Unknown statements are passed over, as the many
    /// extensions of the format ask for.
    fn apply(&self, material: &mut MtlMaterial) -> Result<(), SceneError> {
        match self.lowercase().as_str() {
            "kd" => material.diffuse = Some(self.colour()?),
            "ks" => material.specular = self.colour()?,
            "ke" => material.emission = Some(self.colour()?),
            "ns" => material.shininess = self.number(0)?,
            "d" => {
                let halo = self.words.first().is_some_and(|w| w.eq_ignore_ascii_case("-halo"));
                material.dissolve = Some(self.number(usize::from(halo))?);
            }
            "tr" => material.transparency = self.number(0)?,
            "illum" => material.illumination = self.number(0)?,
            "ni" => material.refraction = Some(self.number(0)?),
            "tf" => material.transmission = Some(self.colour()?),
            "map_kd" => material.diffuse_map = Map::parse(self)?,
            "map_d" => material.opacity_map = Map::parse(self)?,
            "map_ke" => material.emission_map = Map::parse(self)?,
            "map_ka" => {}
            name if name.starts_with("map_") || SURFACE_MAPS.contains(&name) => {
                material.other_maps.push(self.keyword.to_owned());
            }
            _ => {}
        }
        Ok(())
    }

    fn number(&self, index: usize) -> Result<f64, SceneError> {
        let word = self.words.get(index).copied().unwrap_or_default();
        let number = word.parse().ok().filter(|x: &f64| x.is_finite());
        number.ok_or_else(|| self.fault("is followed by no number"))
    }

    /// One number for all channels, or three.
    fn colour(&self) -> Result<DVec3, SceneError> {
        match self.words[..] {
            ["spectral" | "xyz", ..] => {
                Err(self.fault("gives a spectrum or XYZ, which is not supported; give r g b"))
            }
            [_] => Ok(DVec3::splat(self.number(0)?)),
            [_, _, _, ..] => Ok(DVec3::new(self.number(0)?, self.number(1)?, self.number(2)?)),
            _ => Err(self.fault("needs three numbers r g b")),
        }
    }

    fn fault(&self, what: &str) -> SceneError {
        let Self { file, line, keyword, words, .. } = self;
        SceneError::at(*file, *line, format!("`{keyword} {}`: {keyword} {what}", words.join(" ")))
    }
}

/// Textures whose statement does not begin with `map_`.
const SURFACE_MAPS: [&str; 5] = ["bump", "disp", "decal", "refl", "norm"];
