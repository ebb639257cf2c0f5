//! 8-bit PNG.

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
    let bytes = to_rgb8(image, tone);
    PngEncoder::new_with_quality(out, CompressionType::Default, FilterType::Adaptive)
        .write_image(&bytes, image.width, image.height, ExtendedColorType::Rgb8)
        .map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other.to_string()),
        })
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

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
}
