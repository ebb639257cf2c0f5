//! Wavefront MTL, read line by line: what of it is not shown is reported with its line, which
//! `tobj`'s reader does not keep.

mod faults;
mod kind;
mod map;
mod material;
pub mod omitted;
mod statement;
mod surface;

use std::path::Path;

use encoding_rs::Encoding;

use super::text::read_text;
use super::{SceneError, Warning};
use map::Map;
pub use material::MtlMaterial;
use statement::Statement;

/// Reads all materials of a file; of two of one name, the first. It is in the encoding of the mesh that
/// names it, if it can be.
pub fn read(
    file: &Path,
    like: &'static Encoding,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<MtlMaterial>, SceneError> {
    let text = read_text(file, Some(like))?;
    warnings.extend(text.note(file));
    let mut materials = parse(file, &text.content)?;
    for material in &mut materials {
        material.encoding = Some(text.encoding);
    }
    Ok(materials)
}

fn parse(file: &Path, text: &str) -> Result<Vec<MtlMaterial>, SceneError> {
    let mut materials: Vec<MtlMaterial> = Vec::new();
    let mut comments = text.lines().filter(|line| line.trim_start().starts_with('#'));
    let says_blender = comments.any(|comment| comment.to_ascii_lowercase().contains("blender"));
    for (line, content) in (1..).zip(text.lines()) {
        let mut words = content.split_whitespace().take_while(|word| !word.starts_with('#'));
        let Some(keyword) = words.next() else { continue };
        let statement = Statement { file, line, keyword, words: words.collect(), content };
        if keyword.eq_ignore_ascii_case("newmtl") {
            // A name may hold blanks and '#'.
            let name = content.trim_start()[keyword.len()..].trim().to_owned();
            let file = file.to_owned();
            let again = materials.iter().any(|material| material.name == name);
            let unread = MtlMaterial::default();
            materials.push(MtlMaterial { name, file, line, says_blender, again, ..unread });
        } else if let Some(material) = materials.last_mut() {
            statement.apply(material)?;
        } else if statement.is_colour() {
            return Err(SceneError::at(file, line, format!("{keyword} before any newmtl")));
        }
    }
    Ok(materials)
}

impl Statement<'_> {
    /// Notes what it says of a material. Unknown statements are passed over with a note, as the many
    /// extensions of the format ask for.
    fn apply(&self, material: &mut MtlMaterial) -> Result<(), SceneError> {
        let keyword = self.lowercase();
        material.order.extend(ORDERED.iter().copied().find(|ordered| *ordered == keyword));
        match keyword.as_str() {
            "ka" => material.ambient = self.colour().ok(),
            "kd" => material.diffuse = Some(self.colour()?),
            "ks" => material.specular = self.colour()?,
            "ke" => material.emission = Some(self.colour()?),
            "ns" => material.shininess = self.number(0)?,
            "d" => {
                let halo = self.words.first().is_some_and(|w| w.eq_ignore_ascii_case("-halo"));
                let opacity = self.number(usize::from(halo))?;
                material.dissolve = Some(opacity);
                material.omit(omitted::of_halo(opacity).filter(|_| halo), "d -halo");
            }
            "tr" => material.transparency = Some(self.number(0)?),
            "illum" => {
                let model = self.number(0)?;
                material.illumination = Some(model);
                material.omit(omitted::of_illumination(model), &format!("illum {model}"));
            }
            "ni" => material.refraction = Some(self.number(0)?),
            "tf" => material.transmission = Some(self.colour()?),
            "map_kd" => material.diffuse_map = Map::parse(self)?,
            "map_d" => material.opacity_map = Map::parse(self)?,
            "map_ke" => material.emission_map = Map::parse(self)?,
            other => material.omit(omitted::of_statement(other, self.number(0).ok()), self.keyword),
        }
        Ok(())
    }
}

/// Statements whose order tells who wrote them.
const ORDERED: [&str; 10] = ["ns", "ka", "kd", "ks", "ke", "ni", "d", "tr", "tf", "illum"];
