//! Environment maps: Radiance `.hdr` and EXR, whose values are radiance, and images of 8 bits,
//! whose values are sRGB.

use std::io::Cursor;
use std::path::Path;

use glam::{DVec3, Vec3};
use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageDecoder as _};
use rayon::prelude::*;

use super::{Environment, EnvironmentImage, MOST, pack};
use crate::image::exr;
use crate::scene::texture::{decode, linear, read_image};
use crate::scene::{Origin, Warning, normalise};

/// The most texels of a map: 1 GiB packed.
const MOST_TEXELS: u64 = 1 << 28;

/// Greater radiances would overflow when they are rounded up.
const BRIGHTEST: f32 = 1e37;

const EXR: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// A map, and what its values are multiples of.
struct Map {
    image: EnvironmentImage,
    unit: f32,
    /// How many of its texels cannot be, and the first of them.
    impossible: Option<(usize, [usize; 2])>,
}

/// An environment of a map, multiplied by `radiance`, and what was wrong with it. One that
/// cannot be read is magenta.
pub fn read(path: &Path, radiance: DVec3, origin: &Origin) -> (Environment, Option<Warning>) {
    let shown = path.display();
    let magenta = |what: &str| {
        let radiance = normalise::round(radiance * DVec3::new(1.0, 0.0, 1.0));
        let warning = origin.changed(format!("image {shown} {what}; magenta is shown"));
        (Environment { radiance, image: None }, Some(warning))
    };
    let Map { image, unit, impossible } = match read_map(path) {
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
    (Environment { radiance: normalise::round(radiance), image: Some(image) }, warning)
}

fn read_map(path: &Path) -> Result<Map, String> {
    let bytes = read_image(path)?;
    let name = path.display().to_string();
    if bytes.starts_with(&EXR) {
        let image = exr::read(&bytes).map_err(|error| format!("is damaged: {error}"))?;
        drop(bytes);
        let size = [image.width, image.height];
        return Ok(from_radiance(name, size, image.pixels.into_flattened()));
    }
    if bytes.starts_with(b"#?") {
        let (size, pixels) = read_hdr(&bytes)?;
        drop(bytes);
        return Ok(from_radiance(name, size, pixels));
    }
    let decode::Decoded { size, rgba, .. } = decode::decode(&bytes, path)?;
    let table: Vec<f32> = (0..=u8::MAX).map(|value| linear(f32::from(value) / 255.0)).collect();
    let texel = |&[r, g, b, _]: &[u8; 4]| {
        pack(Vec3::from_array([r, g, b].map(|value| table[usize::from(value)])))
    };
    let texels = rgba.par_iter().map(texel).collect();
    Ok(Map { image: EnvironmentImage { name, size, texels }, unit: 1.0, impossible: None })
}

fn read_hdr(bytes: &[u8]) -> Result<([u32; 2], Vec<f32>), String> {
    let damaged = |error: image::ImageError| format!("is damaged: {error}");
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(bytes)).map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    let texels = u64::from(width) * u64::from(height);
    if !(1..=MOST_TEXELS).contains(&texels) {
        return Err(format!("has {width} x {height} texels: none, or more than {MOST_TEXELS}"));
    }
    decode::check_expansion(bytes.len(), 4 * texels)?;
    let image = DynamicImage::from_decoder(decoder).map_err(damaged)?.into_rgb32f();
    Ok(([width, height], image.into_raw()))
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
    Map { image: EnvironmentImage { name, size, texels }, unit, impossible }
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
