//! Image files read back, told apart by their first bytes: EXR, Radiance and TIFF of floats are linear;
//! all others are sRGB.

use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::Path;

use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use super::tone::linear;
use super::{Image, ImageError, Picture, exr, hdr, limits};

/// The largest file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 33;

/// The most bytes that an image may take when it is decoded.
const MOST_DECODED: u64 = 1 << 32;

/// How an EXR file begins.
const EXR: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// Reads a linear image; what is in 8 or 16 bits is taken as sRGB.
///
/// # Errors
/// The file cannot be read, is of no known format, is damaged, or holds no R, G and B.
pub fn read(file: &Path) -> Result<Image, ImageError> {
    read_picture(file, None).map(|picture| picture.image)
}

/// Reads an image, of an EXR file the layer of this name, and what else the file says of it.
///
/// # Errors
/// Those of [`read`]; there is no such layer, or there are several and none is named.
pub fn read_picture(file: &Path, layer: Option<&str>) -> Result<Picture, ImageError> {
    let refuse = |what: String| ImageError::new(file, what);
    let unreadable = |error: io::Error| {
        refuse(format!("cannot read it: {error}; check the name and its rights"))
    };
    let mut from = File::open(file).map_err(unreadable)?.take(MOST_BYTES);
    let mut bytes = Vec::new();
    from.by_ref().take(16).read_to_end(&mut bytes).map_err(unreadable)?;
    let unknown =
        "it is neither PNG nor EXR, nor HDR, TIFF, JPEG, WebP, BMP or GIF; name an image of these";
    let format = match &bytes[..] {
        start if start.starts_with(&EXR) => Known::Exr,
        start if start.starts_with(hdr::MARK) => Known::Hdr,
        start => Known::Other(image::guess_format(start).map_err(|_| refuse(unknown.to_owned()))?),
    };
    from.read_to_end(&mut bytes).map_err(unreadable)?;
    let (name, picture) = match format {
        Known::Exr => ("EXR".to_owned(), exr::read(&bytes, layer)),
        Known::Hdr => ("HDR".to_owned(), hdr::read(&bytes)),
        Known::Other(format) => {
            (format!("{format:?}").to_ascii_uppercase(), decode(&bytes, format))
        }
    };
    let picture =
        picture.map_err(|why| refuse(format!("cannot be read as {name}: {why}; make it anew")))?;
    match layer {
        Some(layer) if !matches!(format, Known::Exr) => {
            Err(refuse(format!("--layer {layer} is for EXR, this is {name}; leave it out")))
        }
        _ => Ok(picture),
    }
}

#[derive(Debug, Clone, Copy)]
enum Known {
    Exr,
    Hdr,
    Other(ImageFormat),
}

/// Decodes an image of a format that the file does not tell by itself alone.
pub(super) fn decode(bytes: &[u8], format: ImageFormat) -> io::Result<Picture> {
    let error = |error: image::ImageError| io::Error::other(error.to_string());
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut bounds = Limits::no_limits();
    bounds.max_alloc = Some(MOST_DECODED);
    reader.limits(bounds);
    let decoder = reader.into_decoder().map_err(error)?;
    let (width, height) = decoder.dimensions();
    limits::area(width.into(), height.into())?;
    let color = decoder.color_type();
    let decoded = DynamicImage::from_decoder(decoder).map_err(error)?;
    let (pixels, alpha): (Vec<[f32; 3]>, Vec<f32>) = match color {
        ColorType::Rgb32F | ColorType::Rgba32F => {
            decoded.into_rgba32f().pixels().map(|pixel| split(pixel.0)).unzip()
        }
        _ => {
            let table: Vec<f32> =
                (0..=u16::MAX).map(|value| linear(f64::from(value) / 65535.0) as f32).collect();
            let encoded = decoded.into_rgba16();
            let pixel = |&[r, g, b, a]: &[u16; 4]| {
                ([r, g, b].map(|v| table[usize::from(v)]), f32::from(a) / 65535.0)
            };
            encoded.pixels().map(|p| pixel(&p.0)).unzip()
        }
    };
    let alpha = color.has_alpha().then_some(alpha);
    Ok(Picture { alpha, ..Picture::of(Image { width, height, pixels }) })
}

fn split([r, g, b, a]: [f32; 4]) -> ([f32; 3], f32) {
    ([r, g, b], a)
}
