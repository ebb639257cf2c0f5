//! OpenEXR read as R, G and B of one layer, of any sample type, placed in the display window.

use std::io::{self, Cursor};

use exr::meta::attribute::{Chromaticities, EnvironmentMap};
use exr::prelude::{AnyChannel, FlatSamples, ReadChannels, ReadLayers, Vec2, read as reader};
use glam::DVec2;

use super::super::primaries::{self, Primaries, REC_709};
use super::super::{Image, Picture, limits};
use super::failed::io_error;

/// The most samples of a file.
const MOST_SAMPLES: u64 = 1 << 30;

/// A part of a file.
type Part = exr::prelude::Layer<exr::prelude::AnyChannels<FlatSamples>>;

/// Some channels of a part that make an image.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Layer {
    part: usize,
    /// As users know it: empty for the image itself.
    name: String,
    /// Which channels are red, green and blue; three times the same for grey.
    rgb: [usize; 3],
    alpha: Option<usize>,
}

/// Reads the layer of this name, or else the image itself, or what stands for it: the layer that is called
/// `Combined`, or the only one there is.
///
/// # Errors
/// The file is damaged, incomplete or too large; it has no such layer, or several and none was named; or
/// only subsampled channels.
pub fn read(file: &[u8], wanted: Option<&str>) -> io::Result<Picture> {
    let chunks = exr::block::read(Cursor::new(file), false).map_err(io_error)?;
    let samples = |header: &exr::meta::header::Header| {
        let Vec2(width, height) = header.layer_size;
        let area = limits::area(width as u64, height as u64).map_err(|error| (error, 0));
        area.map(|area| area as u64 * header.channels.list.len() as u64)
    };
    let mut total = 0_u64;
    for header in chunks.headers() {
        total = total.saturating_add(samples(header).map_err(|(error, _)| error)?);
    }
    if total > MOST_SAMPLES {
        return Err(io::Error::other(format!("{total} samples are more than {MOST_SAMPLES}")));
    }
    let all = reader()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_chunks(chunks)
        .map_err(io_error)?;
    let layers = layers(&all.layer_data);
    let layer = choose(&layers, wanted)?;
    let part = &all.layer_data[layer.part];
    if [Some(layer.rgb[0]), Some(layer.rgb[1]), Some(layer.rgb[2]), layer.alpha]
        .into_iter()
        .flatten()
        .any(|channel| part.channel_data.list[channel].sampling != Vec2(1, 1))
    {
        return Err(io::Error::other("subsampled channels are not supported"));
    }
    let window = all.attributes.display_window;
    let size = window.size;
    let area = limits::area(size.0 as u64, size.1 as u64)?;
    let Vec2(left, top) = part.attributes.layer_position;
    let offset = [left, top].map(i64::from);
    let start = [window.position.0, window.position.1].map(i64::from);
    let offset = [offset[0] - start[0], offset[1] - start[1]];
    let place = |channel: &AnyChannel<FlatSamples>, empty: f32| {
        placed(channel, [part.size.0, part.size.1], offset, [size.0, size.1], empty)
    };
    let channels = layer.rgb.map(|index| place(&part.channel_data.list[index], 0.0));
    let mut pixels: Vec<[f32; 3]> =
        (0..area).map(|at| [0, 1, 2].map(|channel: usize| channels[channel][at])).collect();
    let alpha = layer.alpha.map(|index| place(&part.channel_data.list[index], 0.0));
    let mut notes = Vec::new();
    if offset != [0, 0] || [part.size.0, part.size.1] != [size.0, size.1] {
        notes.push(
            "has a data window other than its display window, in which it is placed".to_owned(),
        );
    }
    let given = all.attributes.chromaticities.as_ref().map(of_attribute);
    if let Some(given) = given.filter(|given| !given.is_like(&REC_709)) {
        match given.to_rec_709() {
            Some(matrix) => {
                notes.push("has other chromaticities, converted to those of Rec. 709".to_owned());
                primaries::convert(&mut pixels, matrix);
            }
            None => notes.push("has chromaticities that span no colours; left out".to_owned()),
        }
    }
    if part.attributes.environment_map == Some(EnvironmentMap::Cube) {
        notes.push("calls itself a cube's faces; read as equirectangular".to_owned());
    }
    let image = Image { width: size.0 as u32, height: size.1 as u32, pixels };
    let layer = Some(layer.name.clone()).filter(|name| !name.is_empty());
    Ok(Picture { image, alpha, layer, notes })
}

/// The samples of a channel where they are in the display window.
fn placed(
    channel: &AnyChannel<FlatSamples>,
    [width, height]: [usize; 2],
    [left, top]: [i64; 2],
    [across, down]: [usize; 2],
    empty: f32,
) -> Vec<f32> {
    if [left, top] == [0, 0] && [width, height] == [across, down] {
        return channel.sample_data.values_as_f32().collect();
    }
    let mut values = vec![empty; across * down];
    for (index, value) in channel.sample_data.values_as_f32().enumerate().take(width * height) {
        let x = left + (index % width) as i64;
        let y = top + (index / width) as i64;
        if (0..across as i64).contains(&x) && (0..down as i64).contains(&y) {
            values[y as usize * across + x as usize] = value;
        }
    }
    values
}

/// All layers that hold colours, or Y alone.
fn layers(parts: &[Part]) -> Vec<Layer> {
    let mut layers = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        let channels: Vec<(String, String)> = part
            .channel_data
            .list
            .iter()
            .map(|channel| {
                let name = channel.name.to_string();
                let (layer, letter) = name.rsplit_once('.').unwrap_or(("", &name));
                (layer.to_owned(), letter.to_ascii_lowercase())
            })
            .collect();
        let mut names: Vec<&String> = channels.iter().map(|(layer, _)| layer).collect();
        names.sort_unstable();
        names.dedup();
        for layer in names {
            let find = |any: [&str; 2]| {
                channels.iter().position(|(of, letter)| of == layer && any.contains(&&**letter))
            };
            let red_green_blue = [["r", "red"], ["g", "green"], ["b", "blue"]].map(find);
            // With X, or with chroma, Y is no grey.
            let is_grey = find(["x", "ry"]).or(find(["z", "by"])).is_none();
            let rgb = match (red_green_blue, find(["y", "y"])) {
                ([Some(r), Some(g), Some(b)], _) => [r, g, b],
                (_, Some(grey)) if is_grey => [grey; 3],
                _ => continue,
            };
            let part_name = part.attributes.layer_name.as_ref().map(ToString::to_string);
            let part_name = part_name.filter(|_| parts.len() > 1).unwrap_or_default();
            let name = match (part_name.is_empty(), layer.is_empty()) {
                (_, true) => part_name,
                (true, false) => layer.clone(),
                (false, false) if layer.starts_with(&part_name) => layer.clone(),
                (false, false) => format!("{part_name}.{layer}"),
            };
            layers.push(Layer { part: index, name, rgb, alpha: find(["a", "alpha"]) });
        }
    }
    layers
}

/// The layer that is meant.
fn choose<'a>(layers: &'a [Layer], wanted: Option<&str>) -> io::Result<&'a Layer> {
    let names = || {
        let names: Vec<&str> =
            layers.iter().map(|l| if l.name.is_empty() { "RGB" } else { &l.name }).collect();
        names.join(", ")
    };
    let one = |test: &dyn Fn(&Layer) -> bool| {
        let mut found = layers.iter().filter(|layer| test(layer));
        found.next().filter(|_| found.next().is_none())
    };
    let last =
        |layer: &Layer| layer.name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
    if let Some(wanted) = wanted {
        let plain = |layer: &Layer| layer.name.is_empty() && wanted.eq_ignore_ascii_case("rgb");
        let found = one(&|layer| layer.name == wanted || plain(layer));
        let found = found.or_else(|| one(&|layer| layer.name.eq_ignore_ascii_case(wanted)));
        let found = found.or_else(|| one(&|layer| last(layer) == wanted.to_ascii_lowercase()));
        return found.ok_or_else(|| {
            io::Error::other(format!("no layer, or several, are {wanted:?}; there are {}", names()))
        });
    }
    let colored = |layer: &Layer| layer.rgb[0] != layer.rgb[1];
    let found = one(&|layer| layer.name.is_empty() && colored(layer))
        .or_else(|| one(&|layer| last(layer) == "combined"))
        .or_else(|| one(&|layer| ["rgba", "rgb", "beauty", "c"].contains(&&*last(layer))))
        .or_else(|| one(&colored))
        .or_else(|| if layers.iter().any(colored) { None } else { one(&|_| true) });
    found.ok_or_else(|| match layers {
        [] => io::Error::other("it has no channels R, G and B"),
        _ => io::Error::other(format!("it has several layers; choose one by --layer: {}", names())),
    })
}

fn of_attribute(given: &Chromaticities) -> Primaries {
    let vector = |at: Vec2<f32>| DVec2::new(at.0.into(), at.1.into());
    let colors = [given.red, given.green, given.blue].map(vector);
    Primaries { colors, white: vector(given.white) }
}
