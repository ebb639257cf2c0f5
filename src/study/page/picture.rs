//! Pictures within a page: linear radiance in 16 bits a channel, compressed, as text.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde::Serialize;

use crate::image::Image;

/// A picture as the page holds it. Encoded once, it may be written many times.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Picture {
    /// What rows and references call it; unique within its scene.
    pub id: String,
    /// What it shows, for people.
    pub label: String,
    /// The scene that it is of, as results call it.
    pub scene: String,
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Its pixels as text.
    #[serde(skip)]
    pub(super) data: String,
}

/// The code of what is not finite. The codes of finite values are below that of infinity.
const NONFINITE: u16 = 0xffff;
const LARGEST: u32 = 0xfeff;

impl Picture {
    /// Encodes an image of radiance, to 0.2 % of every value; what is negative is 0.
    ///
    /// A value is the upper half of its f32 without the sign: its logarithm, more or less.
    /// Green, and red and blue less green, go each into a plane of differences to the left
    /// neighbour, low bytes before high ones. Light that is alike in all channels is stored
    /// once this way, and smooth light is nearly nothing.
    pub fn encode(id: &str, label: &str, scene: &str, image: &Image) -> Self {
        let Image { width, height, .. } = *image;
        // Writing to a vector cannot fail; an empty text would be told by the page.
        let data = compressed(&planes(image)).map(|bytes| base64(&bytes)).unwrap_or_default();
        let [id, label, scene] = [id, label, scene].map(str::to_owned);
        Self { id, label, scene, width, height, data }
    }
}

/// The sixteen bits below the sign of an f32, rounded.
fn code(value: f32) -> u16 {
    if !value.is_finite() {
        return NONFINITE;
    }
    // The sum makes -0 a 0, which `max` may leave as it is.
    let rounded = ((value.max(0.0) + 0.0).to_bits() + (1 << 14)) >> 15;
    rounded.min(LARGEST) as u16
}

fn planes(image: &Image) -> Vec<u8> {
    let codes: Vec<_> = image.pixels.iter().map(|pixel| pixel.map(code)).collect();
    let mut bytes = Vec::with_capacity(6 * codes.len());
    let channels: [fn(&[u16; 3]) -> u16; 3] =
        [|rgb| rgb[1], |rgb| rgb[0].wrapping_sub(rgb[1]), |rgb| rgb[2].wrapping_sub(rgb[1])];
    for channel in channels {
        let plane: Vec<_> = codes.iter().map(channel).collect();
        let differences = differences(&plane, image.width.max(1) as usize);
        bytes.extend(differences.iter().map(|difference| difference.to_le_bytes()[0]));
        bytes.extend(differences.iter().map(|difference| difference.to_le_bytes()[1]));
    }
    bytes
}

/// Each value less that on its left, the first of a row less that above, small ones of either
/// sign as small numbers.
fn differences(plane: &[u16], width: usize) -> Vec<u16> {
    let before = |index: usize| match (index % width, index / width) {
        (0, 0) => 0,
        (0, _) => plane[index - width],
        _ => plane[index - 1],
    };
    let difference = |(index, value): (usize, &u16)| value.wrapping_sub(before(index)) as i16;
    let unsigned = |difference: i16| ((difference << 1) ^ (difference >> 15)) as u16;
    plane.iter().enumerate().map(difference).map(unsigned).collect()
}

/// As zlib, which browsers read by themselves.
fn compressed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes)?;
    encoder.finish()
}

/// RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let byte = |index: usize| u32::from(three.get(index).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for index in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * index) & 63) as usize];
            text.push(if index <= three.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_the_upper_half() {
        let back = |value: f32| f32::from_bits(u32::from(code(value)) << 15);
        for value in [0.0, 1.0, 0.5, 0.75, 1.0 / 256.0, 65536.0] {
            assert_eq!(back(value), value);
        }
        for value in [0.1, 3.3, 1e-20, 1e20] {
            assert!((back(value) / value - 1.0).abs() < 1.0 / 512.0, "{value}");
        }
        assert_eq!([-1.0, -0.0].map(code), [0, 0]);
        assert_eq!([f32::NAN, f32::INFINITY, f32::NEG_INFINITY].map(code), [NONFINITE; 3]);
        assert!(back(f32::MAX).is_finite());
    }

    #[test]
    fn base64_is_that_of_the_rfc() {
        let texts = ["", "f", "fo", "foo", "foob", "fooba", "foobar"];
        let encoded = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        assert_eq!(texts.map(|text| base64(text.as_bytes())), encoded);
        assert_eq!(base64(&[0xff, 0xfe, 0xfb]), "//77");
    }

    #[test]
    fn differences_are_to_the_left_and_above() {
        assert_eq!(differences(&[5, 7, 6, 4, 4, 65535], 3), [10, 4, 1, 1, 0, 9]);
        assert_eq!(differences(&[], 3), Vec::<u16>::new());
    }

    #[test]
    fn smooth_light_takes_little_room() {
        let pixel = |index: u32| [0.2, 0.4, 0.3].map(|c| c * (1.0 + (index % 256) as f32 / 256.0));
        let pixels = (0..256 * 256).map(pixel).collect();
        let picture = Picture::encode("", "", "", &Image { width: 256, height: 256, pixels });
        assert!(picture.data.len() < 256 * 256 / 4, "{}", picture.data.len());
    }
}
