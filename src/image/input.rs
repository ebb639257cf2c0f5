//! Image files read back: PNG or EXR, told apart by their first bytes.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::ImageError;
use super::{Image, exr, png};

/// The largest file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 33;

/// How each format's files begin.
const PNG: [u8; 4] = [0x89, b'P', b'N', b'G'];
const EXR: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// What a format's files are decoded by.
type Decode = fn(&[u8]) -> io::Result<Image>;

/// Reads a linear image; a PNG's values are taken as sRGB.
///
/// # Errors
/// The file cannot be read, is neither PNG nor EXR, is damaged, or holds no R, G and B.
pub fn read(file: &Path) -> Result<Image, ImageError> {
    let refuse = |what: String| ImageError::new(file, what);
    let unreadable = |error: io::Error| {
        refuse(format!("cannot read it: {error}; check the name and its rights"))
    };
    let mut from = File::open(file).map_err(unreadable)?.take(MOST_BYTES);
    let mut bytes = Vec::new();
    from.by_ref().take(4).read_to_end(&mut bytes).map_err(unreadable)?;
    let (format, decode): (_, Decode) = match bytes[..] {
        ref start if start == PNG => ("PNG", png::read),
        ref start if start == EXR => ("EXR", exr::read),
        _ => return Err(refuse("it is neither PNG nor EXR; name an image of these".to_owned())),
    };
    from.read_to_end(&mut bytes).map_err(unreadable)?;
    let damaged = |why| refuse(format!("cannot be read as {format}: {why}; make it anew"));
    decode(&bytes).map_err(damaged)
}
