//! Wavefront MTL, read line by line: what of it cannot be rendered yet is reported with its
//! line, which `tobj`'s reader does not keep.

use std::path::{Path, PathBuf};

use glam::DVec3;

use super::{DraftMaterial, Origin, Warning, obj::read_text};
use crate::error::SceneError;

/// Albedo of what has no material, or a material without colour.
pub const DEFAULT_ALBEDO: DVec3 = DVec3::splat(0.8);

/// Exponent from which on a highlight is a mirror's.
const MIRROR_SHININESS: f64 = 1000.0;

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
    maps: Vec<String>,
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
        let statement = Statement { file, line, keyword, words: words.collect() };
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
            "map_ka" => {}
            name if name.starts_with("map_") || SURFACE_MAPS.contains(&name) => {
                material.maps.push(self.keyword.to_owned());
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
        let Self { file, line, keyword, words } = self;
        SceneError::at(*file, *line, format!("`{keyword} {}`: {keyword} {what}", words.join(" ")))
    }
}

/// Textures whose statement does not begin with `map_`.
const SURFACE_MAPS: [&str; 5] = ["bump", "disp", "decal", "refl", "norm"];

/// How light leaves a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Diffuse,
    Phong,
    Mirror,
    Glass,
}

impl MtlMaterial {
    fn kind(&self) -> Kind {
        let opacity = self.dissolve.unwrap_or(1.0 - self.transparency);
        let cut_out = self.maps.iter().any(|map| map.eq_ignore_ascii_case("map_d"));
        let illumination = self.illumination;
        let black = self.diffuse.unwrap_or_default() == DVec3::ZERO;
        if [4.0, 6.0, 7.0, 9.0].contains(&illumination) || (opacity < 1.0 && !cut_out) {
            Kind::Glass
        } else if [3.0, 5.0].contains(&illumination)
            && (black || self.shininess >= MIRROR_SHININESS)
        {
            Kind::Mirror
        } else if self.specular.max_element() > 0.0 {
            Kind::Phong
        } else {
            Kind::Diffuse
        }
    }

    /// The nearest material that can be rendered, and what was lost on the way.
    pub fn to_draft(&self) -> (DraftMaterial, Option<Warning>) {
        let colourless = self.diffuse.is_none() && self.emission.is_none();
        let given = self.diffuse.unwrap_or(if colourless { DEFAULT_ALBEDO } else { DVec3::ZERO });
        let reflected = (given + self.specular).max_element();
        let material = DraftMaterial {
            name: self.name.clone(),
            albedo: if reflected > 1.0 { (given / reflected).min(DVec3::ONE) } else { given },
            emission: self.emission.unwrap_or_default(),
            two_sided: false,
            origin: Origin::line(&self.file, self.line),
            ..DraftMaterial::default()
        };
        let mut faults = Vec::new();
        if reflected > 1.0 {
            faults.push(format!(
                "reflects more than it receives (Kd + Ks = {reflected:.4}), scaled to 1"
            ));
        }
        if let Some(what) = self.left_out() {
            faults.push(format!("has {what}, not supported yet, Kd alone is used"));
        }
        let changes_image = !faults.is_empty();
        if colourless {
            faults.push("has no Kd, 0.8 is used".to_owned());
        }
        let message = || {
            let Self { file, line, name, .. } = self;
            format!("{}:{line}: material `{name}` {}", file.display(), faults.join("; "))
        };
        let warning =
            (!faults.is_empty()).then(|| Warning { changes_image, ..Warning::note(message()) });
        (material, warning)
    }

    /// What of it is not rendered.
    fn left_out(&self) -> Option<String> {
        let kind = match self.kind() {
            Kind::Diffuse => None,
            Kind::Phong => Some("a Phong highlight"),
            Kind::Mirror => Some("a mirror"),
            Kind::Glass => Some("glass"),
        };
        let maps = self.maps.iter().map(String::as_str);
        let parts: Vec<&str> = kind.into_iter().chain(maps).collect();
        (!parts.is_empty()).then(|| parts.join(", "))
    }
}
