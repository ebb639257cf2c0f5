//! The bytes of image files to texels: PNG, JPEG, WebP, TIFF, GIF, BMP and TGA. No bytes panic, and none take
//! more memory than a file of their length may mean.

use std::io::Cursor;
use std::path::Path;

use glam::DVec3;
use image::ImageFormat::{Bmp, Gif, Jpeg, Png, Tga, Tiff, WebP};
use image::{DynamicImage, ImageDecoder, ImageReader, Limits};

use super::linear;

/// The most texels in a row, and the most rows.
const MOST_EXTENT: u32 = 16384;

/// The most bytes that an image may take when it is decoded.
const MOST_BYTES: u64 = 1 << 30;

/// The most bytes that a byte of a file may become: PNG, which packs best, reaches 8 · 1032.
const MOST_EXPANSION: u64 = 1 << 14;

/// An image of 8 bits a channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decoded {
    /// Width and height, both at least 1.
    pub size: [u32; 2],
    /// Rows from the top.
    pub rgba: Vec<[u8; 4]>,
    /// Whether its alpha is not 1 all over.
    pub has_alpha: bool,
}

/// Whether so few bytes may mean so many.
///
/// # Errors
/// They may not: the reason.
pub fn check_expansion(from: usize, to: u64) -> Result<(), String> {
    match to <= (from as u64).saturating_mul(MOST_EXPANSION) {
        true => Ok(()),
        false => Err("is damaged: its header claims more than its bytes can hold".to_owned()),
    }
}

/// Decodes an image. TGA alone, which has no mark of its own, is known by the name.
///
/// # Errors
/// What is wrong with it, without its name.
pub fn decode(bytes: &[u8], name: &Path) -> Result<Decoded, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| format!("cannot be read: {error}"))?;
    if reader.format().is_none() && name.extension().is_some_and(|e| e.eq_ignore_ascii_case("tga"))
    {
        reader.set_format(Tga);
    }
    let Some(Png | Jpeg | WebP | Tiff | Gif | Bmp | Tga) = reader.format() else {
        return Err("is of an unknown format; make it a PNG or JPEG".to_owned());
    };
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(MOST_EXTENT);
    limits.max_image_height = Some(MOST_EXTENT);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let damaged = |error: image::ImageError| match error {
        image::ImageError::Limits(_) => {
            format!("is larger than {MOST_EXTENT} x {MOST_EXTENT} texels or {MOST_BYTES} bytes")
        }
        error => format!("is damaged: {error}"),
    };
    let decoder = reader.into_decoder().map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 {
        return Err("has no texels".to_owned());
    }
    if decoder.total_bytes() > MOST_BYTES {
        return Err(format!("would take more than {MOST_BYTES} bytes; make it smaller"));
    }
    check_expansion(bytes.len(), decoder.total_bytes())?;
    let image = DynamicImage::from_decoder(decoder).map_err(damaged)?.into_rgba8();
    let rgba: Vec<[u8; 4]> = image.pixels().map(|pixel| pixel.0).collect();
    let has_alpha = rgba.iter().any(|texel| texel[3] != u8::MAX);
    Ok(Decoded { size: [width, height], rgba, has_alpha })
}

impl Decoded {
    /// The mean of its colours in linear light, and that of red, green and blue as they stand.
    pub fn means(&self) -> Means {
        let table: Vec<f64> =
            (0..=u8::MAX).map(|value| f64::from(linear(f32::from(value) / 255.0))).collect();
        let (mut light, mut data, mut alpha) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for &[r, g, b, a] in &self.rgba {
            light += DVec3::from_array([r, g, b].map(|value| table[usize::from(value)]));
            data += DVec3::from_array([r, g, b].map(f64::from));
            alpha += f64::from(a);
        }
        let count = self.rgba.len() as f64;
        let of_255 = 255.0 * count;
        Means { light: light / count, data: data / of_255, alpha: alpha / of_255 }
    }
}

/// What a whole image is on average.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Means {
    /// Of its colours, in linear light.
    pub light: DVec3,
    /// Of its channels, as numbers in [0, 1].
    pub data: DVec3,
    /// Of its alpha, in [0, 1].
    pub alpha: f64,
}
