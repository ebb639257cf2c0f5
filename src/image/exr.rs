//! Linear 32-bit float OpenEXR with metadata, further layers beside the image's R, G, B; read
//! as R, G, B of any sample type.

mod failed;
mod read;

use std::io;

use exr::meta::attribute::AttributeValue;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Layer, LayerAttributes,
    LineOrder, Text, Vec2, WritableImage,
};

use super::Image;
use super::output::Sink;
use failed::io_error;
pub use read::read;

/// The value of a metadata attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Stored as `double`.
    Number(f64),
    /// Stored as `string`; characters outside ASCII become `?`.
    Text(String),
}

/// Named attributes of the file's header.
pub type Metadata = Vec<(&'static str, Value)>;

/// A group of channels of the file.
#[derive(Debug, Clone, Copy)]
pub struct Plane<'a> {
    /// The layer's name; empty for the image itself, whose channels are plain `R`, `G`, `B`.
    pub layer: &'static str,
    /// A letter a channel, for as many of the pixel's components: `RGB`, `XYZ`, or `Z`.
    pub channels: &'static str,
    /// The pixels.
    pub image: &'a Image,
}

/// Writes planes of one size as the channels of one part, so that a reader without an idea of
/// layers still finds the image. Lossless (ZIP), rows in order.
///
/// # Errors
/// The sink or the encoder refuses, or the planes differ in size.
pub fn write(out: &mut dyn Sink, planes: &[Plane<'_>], metadata: &Metadata) -> io::Result<()> {
    let [first, ..] = planes else {
        return Err(io::Error::other("an image without channels"));
    };
    let size = (first.image.width, first.image.height);
    if planes.iter().any(|plane| (plane.image.width, plane.image.height) != size) {
        return Err(io::Error::other("layers of different sizes"));
    }
    let channels = AnyChannels::sort(planes.iter().flat_map(channels_of).collect());
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let size = Vec2(size.0 as usize, size.1 as usize);
    let layer = Layer::new(size, attributes(metadata), encoding, channels);
    let image = exr::prelude::Image::from_layer(layer);
    let writer = image.write();
    // The exr crate has a pool of its own, which knows nothing of `--threads 1`.
    let written = match rayon::current_num_threads() {
        1 => writer.non_parallel().to_buffered(out),
        _ => writer.to_buffered(out),
    };
    written.map_err(io_error)
}

fn channels_of<'a>(plane: &Plane<'a>) -> impl Iterator<Item = AnyChannel<FlatSamples>> + use<'a> {
    let Plane { layer, channels, image } = *plane;
    channels.chars().take(3).enumerate().map(move |(component, letter)| {
        let name = if layer.is_empty() { letter.into() } else { format!("{layer}.{letter}") };
        let samples = image.pixels.iter().map(|pixel| pixel[component]).collect();
        AnyChannel::new(text(&name), FlatSamples::F32(samples))
    })
}

/// `software` names the program; `version` would clash with EXR's own attribute of that name.
fn attributes(metadata: &Metadata) -> LayerAttributes {
    let software = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
    let other = metadata.iter().map(|(name, value)| {
        let value = match value {
            Value::Number(number) => AttributeValue::F64(*number),
            Value::Text(string) => AttributeValue::Text(text(string)),
        };
        (text(name), value)
    });
    LayerAttributes {
        software_name: Some(text(software)),
        other: other.collect(),
        ..LayerAttributes::default()
    }
}

fn text(string: &str) -> Text {
    let ascii = string.chars().map(|c| if c.is_ascii() { c as u8 } else { b'?' });
    Text::from_bytes_unchecked(ascii.collect())
}

#[cfg(test)]
mod tests {
    use exr::prelude::{FlatImage, ReadChannels, ReadLayers, read as reader};

    use std::io::Cursor;

    use super::*;

    /// The image of a file.
    fn read(file: &[u8]) -> io::Result<Image> {
        super::read(file, None).map(|picture| picture.image)
    }

    fn ramp(offset: f32) -> Image {
        let pixels = (0..40).map(|i| [i as f32 * 1e-3, offset, -1e9 * i as f32]).collect();
        Image { width: 8, height: 5, pixels }
    }

    fn file(planes: &[Plane<'_>]) -> Vec<u8> {
        let metadata = vec![("seed", Value::Number(7.0)), ("method", Value::Text("vpl".into()))];
        let mut file = Cursor::new(Vec::new());
        write(&mut file, planes, &metadata).unwrap();
        file.into_inner()
    }

    #[test]
    fn an_exr_reads_back_bit_for_bit_as_plain_rgb() {
        let mut image = ramp(0.1);
        image.pixels[3] = [f32::INFINITY, f32::MIN_POSITIVE, -0.0];
        let file = file(&[Plane { layer: "", channels: "RGB", image: &image }]);
        assert_eq!(read(&file).unwrap().pixels, image.pixels);
        image.pixels[20][1] += 1e-7;
        assert_ne!(read(&file).unwrap().pixels, image.pixels);
    }

    #[test]
    fn layers_and_metadata_are_found_by_name() {
        let (image, normal, depth) = (ramp(0.1), ramp(0.2), ramp(0.3));
        let file = file(&[
            Plane { layer: "", channels: "RGB", image: &image },
            Plane { layer: "normal", channels: "XYZ", image: &normal },
            Plane { layer: "depth", channels: "Z", image: &depth },
        ]);
        assert_eq!(read(&file).unwrap().pixels, image.pixels);
        let read = read_all_flat_layers_from(&file);
        let layer = &read.layer_data[0];
        let names: Vec<_> =
            layer.channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R", "depth.Z", "normal.X", "normal.Y", "normal.Z"]);
        let y: Vec<f32> = layer.channel_data.list[5].sample_data.values_as_f32().collect();
        assert_eq!(y, [0.2; 40]);
        let other = &layer.attributes.other;
        assert_eq!(other[&text("seed")], AttributeValue::F64(7.0));
        assert_eq!(other[&text("method")], AttributeValue::Text(text("vpl")));
        assert!(layer.attributes.software_name.is_some());
    }

    fn read_all_flat_layers_from(file: &[u8]) -> FlatImage {
        reader()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_buffered(Cursor::new(file))
            .unwrap()
    }

    #[test]
    fn planes_of_different_sizes_are_refused() {
        let image = ramp(0.0);
        let small = Image { width: 1, height: 1, pixels: vec![[0.0; 3]] };
        let planes = [
            Plane { layer: "", channels: "RGB", image: &image },
            Plane { layer: "depth", channels: "Z", image: &small },
        ];
        assert!(write(&mut Cursor::new(Vec::new()), &planes, &Vec::new()).is_err());
        assert!(write(&mut Cursor::new(Vec::new()), &[], &Vec::new()).is_err());
    }

    #[test]
    fn channels_of_a_layer_stand_in_for_plain_ones() {
        let (image, other) = (ramp(0.1), ramp(0.2));
        let named = file(&[
            Plane { layer: "depth", channels: "Z", image: &other },
            Plane { layer: "light", channels: "RGB", image: &image },
        ]);
        assert_eq!(read(&named).unwrap(), image);
        let without = file(&[Plane { layer: "normal", channels: "XYZ", image: &image }]);
        assert!(read(&without).unwrap_err().to_string().contains("no channels R, G and B"));
    }

    #[test]
    fn what_is_damaged_is_refused() {
        let image = ramp(0.1);
        let whole = file(&[Plane { layer: "", channels: "RGB", image: &image }]);
        for length in 0..whole.len() {
            assert!(read(&whole[..length]).is_err(), "{length} of {} bytes", whole.len());
        }
        // Any byte may be anything: an error or an image, but never a panic.
        for index in 0..whole.len() {
            for value in [0, 1, 0x7f, 0x80, 0xff] {
                let mut file = whole.clone();
                file[index] = value;
                let _ = read(&file);
            }
        }
    }
}
