//! The images that a scene's files name, each read once.

use std::borrow::Cow;
use std::collections::HashMap;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::decode::{Decoded, Means, decode};
use super::{Texels, Texture};
use crate::scene::{Draft, Origin};

/// The largest image file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 30;

/// The images of a draft that were read, by their file and what was taken of it.
#[derive(Debug, Clone, Default)]
pub struct ImageFiles {
    known: HashMap<(PathBuf, Part), Known>,
    means: HashMap<PathBuf, Option<Means>>,
}

/// An image of a draft, and whether its file has an alpha channel.
#[derive(Debug, Clone, Copy)]
struct Known {
    index: u32,
    has_alpha: bool,
}

/// What is taken of an image file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Part {
    /// Colour and alpha.
    Color,
    /// Opacity as alpha: its alpha channel, or its luminance if it has none.
    Opacity,
    /// Alpha, so that values from this one on become one half and more.
    AlphaFrom(u8),
}

/// The alpha from which on there is a surface, as [`super::Texture`] has it.
const HALF: u8 = 128;

/// The bytes of an image file.
///
/// # Errors
/// Why they cannot be read, without the file's name.
pub fn read_image(path: &Path) -> Result<Cow<'static, [u8]>, String> {
    // Anything but a file may have no end.
    if !path.is_file() {
        return Err("is not there, or no file; put it there".to_owned());
    }
    let read = || {
        let mut bytes = Vec::new();
        File::open(path)?.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let bytes = read().map_err(|error: std::io::Error| format!("cannot be read: {error}"))?;
    match bytes.len() as u64 <= MOST_BYTES {
        true => Ok(Cow::Owned(bytes)),
        false => Err(format!("is larger than {MOST_BYTES} bytes")),
    }
}

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
        let part = if part == Part::AlphaFrom(HALF) { Part::Color } else { part };
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
            None => read().and_then(|bytes| decode(&bytes, path)),
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

impl Part {
    fn of(self, decoded: Decoded, name: String) -> Texels {
        let Decoded { size, mut rgba, has_alpha } = decoded;
        let alpha = |[r, g, b, a]: [u8; 4]| match self {
            Self::Color => a,
            Self::Opacity if has_alpha => a,
            Self::Opacity => {
                let [r, g, b] = [r, g, b].map(f32::from);
                (0.2126 * r + 0.7152 * g + 0.0722 * b).round() as u8
            }
            // The ends of the steps keep their sides of one half.
            Self::AlphaFrom(least) => {
                let stretch = 127.5 / (f32::from(least) - 0.5).max(0.5);
                (stretch * f32::from(a)).round() as u8
            }
        };
        for texel in &mut rgba {
            texel[3] = alpha(*texel);
        }
        Texels { name, size, rgba }
    }
}
