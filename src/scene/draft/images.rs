//! The images that a draft's files name, each read once.

use std::borrow::Cow;
use std::path::Path;

use super::{Draft, Origin};
use crate::scene::texture::decode::{Decoded, Means, decode};
use crate::scene::texture::{Known, Part, Texels, Texture, omitted, read_image};

impl Draft {
    /// The texture of a whole image file, repeated. One that cannot be read is magenta, with a
    /// warning.
    pub fn texture_file(&mut self, path: &Path, origin: &Origin) -> u32 {
        let image = self.image(path, Part::Color, origin, || read_image(path));
        self.add_texture(Texture::of(image))
    }

    /// An image of the bytes that `read` gives, if they were not read before under this path.
    /// One that cannot be read is magenta, with a warning.
    pub fn image<'a>(
        &mut self,
        path: &Path,
        part: Part,
        origin: &Origin,
        read: impl FnOnce() -> Result<Cow<'a, [u8]>, String>,
    ) -> u32 {
        let part = if part == Part::AlphaFrom(Part::HALF) { Part::Color } else { part };
        let key = |part| (path.to_owned(), part);
        if let Some(known) = self.image_files.known.get(&key(part)) {
            return known.index;
        }
        let name = path.display().to_string();
        let color = self.image_files.known.get(&key(Part::Color)).copied();
        let decoded = match color {
            Some(Known { index, has_alpha }) => {
                let Texels { size, rgba, .. } = self.images[index as usize].clone();
                Ok(Decoded { size, rgba, has_alpha })
            }
            None => read().and_then(|bytes| {
                let decoded = decode(&bytes, path)?;
                let notes = omitted::of(&bytes)
                    .map(|omission| origin.note(format!("image {name} {}", omission.instead)));
                self.warnings.extend(notes);
                Ok(decoded)
            }),
        };
        let known = match (decoded, color) {
            // Its own alpha is what it is.
            (Ok(Decoded { has_alpha: true, .. }), Some(color)) if part == Part::Opacity => color,
            (Ok(decoded), _) => {
                let has_alpha = decoded.has_alpha;
                let known = Known { index: self.add_image(part.of(decoded, name)), has_alpha };
                if has_alpha && part == Part::Opacity {
                    self.image_files.known.insert(key(Part::Color), known);
                }
                known
            }
            (Err(what), _) => {
                let shown = match part {
                    Part::Color => "magenta is shown",
                    _ => "nothing is cut out",
                };
                self.warnings.push(origin.changed(format!("image {name} {what}; {shown}")));
                let known = Known { index: self.add_image(Texels::magenta(name)), has_alpha: true };
                self.image_files.known.insert(key(Part::Color), known);
                known
            }
        };
        self.image_files.known.insert(key(part), known);
        known.index
    }

    /// Whether the image of a texture has an alpha that is not 1 all over.
    pub fn has_holes(&self, texture: u32) -> bool {
        let image = self.textures[texture as usize].image;
        self.images[image as usize].rgba.iter().any(|texel| texel[3] != u8::MAX)
    }

    /// The mean of such an image; none if it cannot be read, with a warning that ends as told.
    pub fn image_means<'a>(
        &mut self,
        path: &Path,
        origin: &Origin,
        otherwise: &str,
        read: impl FnOnce() -> Result<Cow<'a, [u8]>, String>,
    ) -> Option<Means> {
        if let Some(&means) = self.image_files.means.get(path) {
            return means;
        }
        let decoded = read().and_then(|bytes| decode(&bytes, path));
        let means = match decoded {
            Ok(decoded) => Some(decoded.means()),
            Err(what) => {
                let name = path.display();
                self.warnings.push(origin.changed(format!("image {name} {what}; {otherwise}")));
                None
            }
        };
        self.image_files.means.insert(path.to_owned(), means);
        means
    }
}
