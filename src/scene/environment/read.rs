//! Environment maps: Radiance `.hdr` and EXR, whose values are radiance, and images of 8 bits,
//! whose values are sRGB.

use std::path::Path;

use glam::{DQuat, DVec3, Vec3};
use rayon::prelude::*;

use super::turn::turned;
use super::{Environment, EnvironmentImage, MOST, pack};
use crate::image::{Picture, exr, hdr};
use crate::scene::texture::{decode, linear, read_image};
use crate::scene::{Origin, Warning, normalise};

/// Greater radiances would overflow when they are rounded up.
const BRIGHTEST: f32 = 1e37;

const EXR: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// A map, and what its values are multiples of.
struct Map {
    image: EnvironmentImage,
    unit: f32,
    /// How many of its texels cannot be, and the first of them.
    impossible: Option<(usize, [usize; 2])>,
    /// What was read otherwise than it stands.
    notes: Vec<String>,
}

/// An environment of a map, multiplied by `radiance` and turned, and what was wrong with it. One that
/// cannot be read is magenta.
pub fn read(
    path: &Path,
    radiance: DVec3,
    turn: DQuat,
    origin: &Origin,
) -> (Environment, Vec<Warning>) {
    let shown = path.display();
    let magenta = |what: &str| {
        let radiance = normalise::round(radiance * DVec3::new(1.0, 0.0, 1.0));
        let warning = origin.changed(format!("image {shown} {what}; magenta is shown"));
        (Environment { radiance, image: None }, vec![warning])
    };
    let Map { image, unit, impossible, notes } = match read_map(path, turn) {
        Ok(map) => map,
        Err(what) => return magenta(&what),
    };
    let radiance = radiance * f64::from(unit);
    if !normalise::is_power(radiance) {
        return magenta("is brighter than f32 can hold");
    }
    let warning = impossible.map(|(count, [x, y])| {
        let what = "negative, beyond 1e37 or no numbers; they are 0 here";
        origin.changed(format!("image {shown}: {count} pixels, the first at {x}, {y}, are {what}"))
    });
    let notes = notes.iter().map(|note| origin.note(format!("image {shown} {note}")));
    let probe = probe(image.size).map(|what| {
        origin.changed(format!("image {shown} has the shape of {what}; read as equirectangular"))
    });
    let warnings = notes.chain(probe).chain(warning).collect();
    (Environment { radiance: normalise::round(radiance), image: Some(image) }, warnings)
}

/// What maps of this shape are that are not equirectangular.
fn probe(size: [u32; 2]) -> Option<&'static str> {
    /// Smaller ones are made by hand.
    const LEAST: u32 = 32;
    let [width, height] = size.map(u64::from);
    match () {
        _ if size[0].min(size[1]) < LEAST => None,
        _ if width == height => Some("an angular map, a mirrored ball or a face of a cube"),
        _ if 3 * width == 4 * height || 4 * width == 3 * height => Some("a cube's cross"),
        _ if width == 6 * height || 6 * width == height => Some("a cube's strip"),
        _ => None,
    }
}

fn read_map(path: &Path, turn: DQuat) -> Result<Map, String> {
    let bytes = read_image(path)?;
    let name = path.display().to_string();
    let read = match &bytes[..] {
        start if start.starts_with(&EXR) => Some(exr::read(&bytes, None)),
        start if start.starts_with(hdr::MARK) => Some(hdr::read(&bytes)),
        _ => None,
    };
    if let Some(read) = read {
        let Picture { image, layer, mut notes, .. } =
            read.map_err(|error| format!("is damaged: {error}"))?;
        drop(bytes);
        notes.extend(layer.map(|layer| format!("has layers, of which {layer} is read")));
        let size = [image.width, image.height];
        let pixels = turned(size, image.pixels, turn);
        return Ok(Map { notes, ..from_radiance(name, size, pixels.into_flattened()) });
    }
    let decode::Decoded { size, rgba, .. } = decode::decode(&bytes, path)?;
    let table: Vec<f32> = (0..=u8::MAX).map(|value| linear(f32::from(value) / 255.0)).collect();
    let pixel = |&[r, g, b, _]: &[u8; 4]| [r, g, b].map(|value| table[usize::from(value)]);
    let pixels = turned(size, rgba.par_iter().map(pixel).collect(), turn);
    let texels = pixels.par_iter().map(|&pixel| pack(Vec3::from_array(pixel))).collect();
    let image = EnvironmentImage { name, size, texels };
    Ok(Map { image, unit: 1.0, impossible: None, notes: Vec::new() })
}

/// Packs radiances, in a unit that the largest of them fits.
fn from_radiance(name: String, size: [u32; 2], mut channels: Vec<f32>) -> Map {
    let pixels = channels.as_chunks_mut::<3>().0;
    let possible = |c: &f32| (0.0..=BRIGHTEST).contains(c);
    let width = size[0] as usize;
    let first = pixels.iter().position(|pixel| !pixel.iter().all(possible));
    let impossible = first.map(|first| {
        let mut count = 0;
        for pixel in pixels[first..].iter_mut().filter(|pixel| !pixel.iter().all(possible)) {
            *pixel = pixel.map(|c| if possible(&c) { c } else { 0.0 });
            count += 1;
        }
        (count, [first % width, first / width])
    });
    let most = channels.iter().copied().fold(0.0, f32::max);
    let unit = unit(most);
    let pixels = channels.as_chunks::<3>().0;
    let texels = pixels.par_iter().map(|&pixel| pack(Vec3::from_array(pixel) / unit)).collect();
    let image = EnvironmentImage { name, size, texels };
    Map { image, unit, impossible, notes: Vec::new() }
}

/// The power of two in which `most` is at most [`MOST`], and not so small that packing would
/// lose it.
fn unit(most: f32) -> f32 {
    /// Below, a unit would not be a normal number of the graphics card.
    const LEAST: f32 = 1e-30;
    let mut unit = 1.0;
    while most / unit > MOST {
        unit *= 2.0;
    }
    while most / unit < 1.0 && unit > LEAST {
        unit *= 0.5;
    }
    unit
}

#[cfg(test)]
mod tests {
    use super::super::unpack;
    use super::*;

    #[test]
    fn bright_and_dim_maps_fit_their_units() {
        for most in [0.0, 1e-29, 3e-12, 0.7, 1.0, 4e4, 7e4, 1e20, BRIGHTEST] {
            let map =
                from_radiance(String::new(), [2, 1], vec![most, most, most, 0.5 * most, 0.0, 0.0]);
            let got = |i: usize| map.unit * unpack(map.image.texels[i]);
            assert!((got(0) - most).abs().max_element() <= most / 256.0, "{most}");
            assert!((got(1).x - 0.5 * most).abs() <= most / 256.0, "{most}");
            assert!((1.0..=MOST).contains(&most) == (map.unit == 1.0) || most == 0.0);
        }
    }

    #[test]
    fn what_cannot_be_is_0_and_counted() {
        let pixels = vec![[1.0; 3], [2.0, f32::NAN, 3.0], [-1.0, 4.0, f32::INFINITY], [5.0; 3]]
            .into_flattened();
        let map = from_radiance(String::new(), [2, 2], pixels);
        assert_eq!(map.impossible, Some((2, [1, 0])));
        let texels: Vec<Vec3> = map.image.texels.iter().map(|&texel| unpack(texel)).collect();
        assert_eq!(texels[1], Vec3::new(2.0, 0.0, 3.0));
        assert_eq!((texels[2], texels[3]), (Vec3::new(0.0, 4.0, 0.0), Vec3::splat(5.0)));
    }
}
