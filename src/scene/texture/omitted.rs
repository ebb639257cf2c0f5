//! What image files have and textures do not show.

use std::io::Cursor;

use image::metadata::Orientation;
use image::{ImageDecoder as _, ImageReader};

use crate::scene::omission::Omission;

const ANIMATION: Omission =
    row("frames after the first", "has several frames, of which the first is shown");
const PROFILE: Omission = row(
    "colour profiles",
    "has a colour profile or a gamma that is not sRGB's; it is taken as sRGB",
);
const ORIENTATION: Omission =
    row("EXIF orientation", "is turned by its EXIF orientation, which is left out");

/// All of it.
pub const OMITTED: [Omission; 4] = [
    ANIMATION,
    PROFILE,
    ORIENTATION,
    Omission {
        what: "files that are no PNG, JPEG, WebP, TIFF, GIF, BMP or TGA",
        instead: "is of an unknown format; make it a PNG or JPEG; magenta is shown",
        changes_image: true,
        ..ANIMATION
    },
];

const fn row(what: &'static str, instead: &'static str) -> Omission {
    Omission { format: "textures", what, instead, changes_image: false }
}

/// What is left out of a file that can be decoded.
pub fn of(bytes: &[u8]) -> impl Iterator<Item = Omission> {
    let is = [
        (is_animated(bytes), ANIMATION),
        (has_profile(bytes), PROFILE),
        (is_turned(bytes), ORIENTATION),
    ];
    is.into_iter().filter_map(|(is, omission)| is.then_some(omission))
}

fn is_animated(bytes: &[u8]) -> bool {
    if bytes.starts_with(b"GIF8") {
        // The blocks that come before each frame of an animation.
        let controls = bytes.windows(3).filter(|window| *window == [0x21, 0xf9, 4]);
        return controls.take(2).count() > 1;
    }
    if bytes.starts_with(b"RIFF") {
        return bytes.get(8..).unwrap_or_default().windows(4).take(64).any(|kind| kind == b"ANIM");
    }
    chunks(bytes).any(|(kind, _)| kind == b"acTL")
}

fn has_profile(bytes: &[u8]) -> bool {
    let says_srgb = |profile: &[u8]| profile.windows(4).any(|word| word == b"sRGB");
    let of_png = chunks(bytes).any(|(kind, content)| match kind {
        b"iCCP" => !says_srgb(&content[..content.len().min(80)]),
        b"gAMA" => {
            let gamma = content.first_chunk().map(|bytes| u32::from_be_bytes(*bytes));
            // 1 / 2.2 in 100,000ths, and what else is meant for it.
            gamma.is_some_and(|gamma| !(45_000..46_000).contains(&gamma))
        }
        _ => false,
    });
    let mark = b"ICC_PROFILE\0";
    let start = bytes[..bytes.len().min(1 << 16)].windows(mark.len()).position(|at| at == mark);
    let of_jpeg = bytes.starts_with(&[0xff, 0xd8]).then_some(start).flatten();
    of_png || of_jpeg.is_some_and(|start| !says_srgb(&bytes[start..bytes.len().min(start + 8192)]))
}

fn is_turned(bytes: &[u8]) -> bool {
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok();
    let decoder = reader.and_then(|reader| reader.into_decoder().ok());
    let turned = decoder.and_then(|mut decoder| decoder.orientation().ok());
    turned.is_some_and(|orientation| orientation != Orientation::NoTransforms)
}

/// The kinds and contents of a PNG's chunks before its pixels.
fn chunks(bytes: &[u8]) -> impl Iterator<Item = (&[u8; 4], &[u8])> {
    let mut rest = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n").unwrap_or_default();
    std::iter::from_fn(move || {
        let length = u32::from_be_bytes(*rest.first_chunk()?) as usize;
        let kind: &[u8; 4] = rest.get(4..)?.first_chunk()?;
        let content = rest.get(8..8_usize.checked_add(length)?)?;
        rest = rest.get(12 + length..).unwrap_or_default();
        (kind != b"IDAT").then_some((kind, content))
    })
}
