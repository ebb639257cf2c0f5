//! PNG: written with 8 bits a channel.

use std::io;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};

use super::Image;
use super::output::Sink;
use super::tone::{Tone, to_rgb8};

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

fn io_error(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::super::input::decode;
    use super::super::tone::linear;
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
        let read = |file: &[u8]| decode(file, image::ImageFormat::Png);
        assert_eq!(read(file.get_ref()).unwrap().image, image);
        for length in [0, 8, 30, file.get_ref().len() / 2] {
            assert!(read(&file.get_ref()[..length]).is_err());
        }
    }
}
