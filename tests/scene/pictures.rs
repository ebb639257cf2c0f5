//! Small image files, made here.

use std::io::Cursor;

use exr::prelude::WritableImage;
use image::{DynamicImage, ImageFormat, Rgb, Rgb32FImage, RgbImage, RgbaImage};

/// Red and green above, blue and half-opaque grey below.
pub const QUARTERS: [[u8; 4]; 4] =
    [[255, 0, 0, 255], [0, 255, 0, 200], [0, 0, 255, 100], [188, 188, 188, 0]];

/// An image file of two texels in a row.
pub fn rgba(format: ImageFormat, texels: &[[u8; 4]]) -> Vec<u8> {
    let image = RgbaImage::from_raw(2, texels.len() as u32 / 2, texels.as_flattened().to_vec());
    let image = DynamicImage::from(image.unwrap());
    match format {
        ImageFormat::Jpeg => encode(&DynamicImage::from(image.into_rgb8()), format),
        _ => encode(&image, format),
    }
}

/// A PNG of two texels in a row.
pub fn png(texels: &[[u8; 4]]) -> Vec<u8> {
    rgba(ImageFormat::Png, texels)
}

/// An image file without an alpha channel.
pub fn rgb(format: ImageFormat, width: u32, texels: &[[u8; 3]]) -> Vec<u8> {
    let height = texels.len() as u32 / width;
    let image = RgbImage::from_raw(width, height, texels.as_flattened().to_vec()).unwrap();
    encode(&DynamicImage::from(image), format)
}

/// The bytes of a file of any format.
pub fn encode(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A Radiance file.
pub fn hdr(width: u32, texels: &[[f32; 3]]) -> Vec<u8> {
    let texel = |x: u32, y: u32| Rgb(texels[(y * width + x) as usize]);
    let image = Rgb32FImage::from_fn(width, texels.len() as u32 / width, texel);
    encode(&DynamicImage::from(image), ImageFormat::Hdr)
}

/// An EXR.
pub fn exr(width: usize, texels: &[[f32; 3]]) -> Vec<u8> {
    let texel = |exr::prelude::Vec2(x, y): exr::prelude::Vec2<usize>| {
        let [r, g, b] = texels[y * width + x];
        (r, g, b)
    };
    let channels = exr::prelude::SpecificChannels::rgb(texel);
    let image = exr::prelude::Image::from_channels((width, texels.len() / width), channels);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// The header of a PNG that claims this size, and nothing behind it.
pub fn claims(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = png(&QUARTERS);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let crc = crc32(&bytes[12..29]).to_be_bytes();
    bytes[29..33].copy_from_slice(&crc);
    bytes
}

/// That of PNG's chunks (ISO 3309).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            if crc & 1 == 1 { 0xedb8_8320 ^ (crc >> 1) } else { crc >> 1 }
        })
    })
}
