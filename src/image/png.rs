//! PNG: written with 8 bits a channel, read with any.

use std::io::{self, Cursor};

use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, ImageError};

use super::output::Sink;
use super::tone::{Tone, linear, to_rgb8};
use super::{Image, limits};

/// Writes an image as 8-bit RGB.
///
/// # Errors
/// The sink or the encoder refuses.
pub fn write(out: &mut dyn Sink, image: &Image, tone: Tone) -> io::Result<()> {
    write_rgb8(out, [image.width, image.height], &to_rgb8(image, tone))
}

/// Writes 8-bit RGB, row by row.
///
/// # Errors
/// The sink or the encoder refuses.
pub fn write_rgb8(out: &mut dyn Sink, [width, height]: [u32; 2], bytes: &[u8]) -> io::Result<()> {
    PngEncoder::new_with_quality(out, CompressionType::Default, FilterType::Adaptive)
        .write_image(bytes, width, height, ExtendedColorType::Rgb8)
        .map_err(io_error)
}

/// Reads a file of any depth and number of channels as linear RGB, its values being sRGB;
/// grey becomes RGB, alpha is left out.
///
/// # Errors
/// The file is damaged or too large.
pub fn read(file: &[u8]) -> io::Result<Image> {
    let decoder = PngDecoder::new(Cursor::new(file)).map_err(io_error)?;
    let (width, height) = decoder.dimensions();
    limits::area(width.into(), height.into())?;
    let encoded = DynamicImage::from_decoder(decoder).map_err(io_error)?.into_rgb16();
    let linear: Vec<f32> =
        (0..=u16::MAX).map(|value| linear(f64::from(value) / 65535.0) as f32).collect();
    let pixels = encoded.pixels().map(|pixel| pixel.0.map(|value| linear[usize::from(value)]));
    Ok(Image { width, height, pixels: pixels.collect() })
}

fn io_error(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip(image: &Image, tone: Tone) -> Vec<u8> {
        let mut file = Cursor::new(Vec::new());
        write(&mut file, image, tone).unwrap();
        let read = image::load_from_memory(file.get_ref()).unwrap();
        assert_eq!((read.width(), read.height()), (image.width, image.height));
        read.into_rgb8().into_raw()
    }

    #[test]
    fn a_png_reads_back_as_written() {
        let pixels = (0..35).map(|i| [i as f32 / 34.0, 0.25, 1.0 - i as f32 / 34.0]).collect();
        let mut image = Image { width: 7, height: 5, pixels };
        let tone = Tone::Radiance { exposure: 0.0 };
        let expected = to_rgb8(&image, tone);
        assert_eq!(round_trip(&image, tone), expected);
        // A perturbed pixel must be seen, else the comparison above proves nothing.
        image.pixels[17][1] = 0.26;
        assert_ne!(round_trip(&image, tone), expected);
    }

    #[test]
    fn what_was_written_is_read_linearly() {
        let pixels = (0..=255).map(|i| [linear(f64::from(i) / 255.0) as f32, 0.0, 1.0]).collect();
        let image = Image { width: 16, height: 16, pixels };
        let mut file = Cursor::new(Vec::new());
        write(&mut file, &image, Tone::Radiance { exposure: 0.0 }).unwrap();
        assert_eq!(read(file.get_ref()).unwrap(), image);
        for length in [0, 8, 30, file.get_ref().len() / 2] {
            assert!(read(&file.get_ref()[..length]).is_err());
        }
    }
}
