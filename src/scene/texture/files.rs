//! The images that a scene's files name, each read once.

use std::borrow::Cow;
use std::collections::HashMap;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::Texels;
use super::decode::{Decoded, Means};

/// The largest image file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 30;

/// The images of a draft that were read, by their file and what was taken of it.
#[derive(Debug, Clone, Default)]
pub struct ImageFiles {
    pub(in crate::scene) known: HashMap<(PathBuf, Part), Known>,
    pub(in crate::scene) means: HashMap<PathBuf, Option<Means>>,
}

/// An image of a draft, and whether its file has an alpha channel.
#[derive(Debug, Clone, Copy)]
pub(in crate::scene) struct Known {
    pub(in crate::scene) index: u32,
    pub(in crate::scene) has_alpha: bool,
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

impl Part {
    /// The alpha from which on there is a surface, as [`super::Texture`] has it.
    pub(in crate::scene) const HALF: u8 = 128;

    pub(in crate::scene) fn of(self, decoded: Decoded, name: String) -> Texels {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cutoff_becomes_one_half() {
        let rgba: Vec<[u8; 4]> = (0..=u8::MAX).map(|alpha| [0, 0, 0, alpha]).collect();
        for least in 1..=u8::MAX {
            let decoded = Decoded { size: [16, 16], rgba: rgba.clone(), has_alpha: true };
            let texels = Part::AlphaFrom(least).of(decoded, String::new());
            for (was, is) in rgba.iter().zip(&texels.rgba) {
                assert_eq!(was[3] >= least, is[3] >= Part::HALF, "{least}: {was:?} {is:?}");
            }
        }
    }
}
