//! Radiance's `.hdr` (`.pic`), as its library reads it (Ward, "Real Pixels", Graphics Gems II, 1991; the
//! header: `color.h` and `resolu.h` of Radiance): in RGB or XYZ, the first pixel in any corner, rows or
//! columns.

use std::io::{self, Cursor};

use glam::{DVec2, DVec3};
use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageDecoder as _};

use super::primaries::{self, Primaries, REC_709};
use super::{Image, Picture, limits};

/// How a file begins.
pub const MARK: &[u8] = b"#?";

/// The most bytes of a header.
const MOST_HEADER: usize = 1 << 16;

/// What the header says.
#[derive(Debug)]
struct Header {
    is_xyz: bool,
    /// What values are divided by.
    exposure: f64,
    correction: DVec3,
    primaries: Option<Primaries>,
    /// Whether scan lines are columns.
    columns: bool,
    /// Whether x and y grow from the left and from the top.
    forward: [bool; 2],
    width: u32,
    height: u32,
    /// Where the scan lines begin.
    end: usize,
}

/// Reads a file as radiance: what `EXPOSURE` and `COLORCORR` say has been multiplied is divided by.
///
/// # Errors
/// It is damaged or too large.
pub fn read(bytes: &[u8]) -> io::Result<Picture> {
    let header = Header::read(bytes)?;
    let area = limits::area(header.width.into(), header.height.into())?;
    let [across, down] = match header.columns {
        true => [header.height, header.width],
        false => [header.width, header.height],
    };
    // As the decoder wants them: rows from the top.
    let plain = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {down} +X {across}\n");
    let scan_lines = bytes.get(header.end..).unwrap_or_default();
    let expansion = scan_lines.len() as u64 * (1 << 14);
    if 4 * area as u64 > expansion {
        return Err(io::Error::other("its header claims more than its bytes can hold"));
    }
    let file = [plain.as_bytes(), scan_lines].concat();
    let error = |error: image::ImageError| io::Error::other(error.to_string());
    let decoder = HdrDecoder::new_nonstrict(Cursor::new(file)).map_err(error)?;
    debug_assert_eq!(decoder.dimensions(), (across, down));
    let decoded = DynamicImage::from_decoder(decoder).map_err(error)?.into_rgb32f().into_raw();
    let mut pixels = header.upright(decoded.as_chunks::<3>().0);
    let mut notes = Vec::new();
    if header.is_xyz {
        notes.push("is in XYZ, converted to RGB".to_owned());
        primaries::from_xyz().into_iter().for_each(|m| primaries::convert(&mut pixels, m));
    } else if let Some(given) = header.primaries.filter(|given| !given.is_like(&REC_709)) {
        match given.to_rec_709() {
            Some(matrix) => {
                notes.push("has other primaries, converted to those of Rec. 709".to_owned());
                primaries::convert(&mut pixels, matrix);
            }
            None => notes.push("has primaries that span no colours; left out".to_owned()),
        }
    }
    let multiplied = header.exposure * header.correction;
    if multiplied != DVec3::ONE {
        notes.push("has an EXPOSURE or COLORCORR, divided by".to_owned());
        let by = (DVec3::ONE / multiplied).as_vec3();
        pixels.iter_mut().for_each(|pixel| {
            *pixel = (glam::Vec3::from_array(*pixel) * by).to_array();
        });
    }
    let image = Image { width: header.width, height: header.height, pixels };
    Ok(Picture { notes, ..Picture::of(image) })
}

impl Header {
    fn read(bytes: &[u8]) -> io::Result<Self> {
        let damaged = |what: &str| io::Error::other(format!("its header {what}"));
        let mut header = Self {
            is_xyz: false,
            exposure: 1.0,
            correction: DVec3::ONE,
            primaries: None,
            columns: false,
            forward: [true; 2],
            width: 0,
            height: 0,
            end: 0,
        };
        let text = &bytes[..bytes.len().min(MOST_HEADER)];
        let mut lines = text.split_inclusive(|&byte| byte == b'\n').map(|line| {
            header.end += line.len();
            String::from_utf8_lossy(line).trim().to_owned()
        });
        let attributes: Vec<String> = lines.by_ref().take_while(|line| !line.is_empty()).collect();
        let resolution = lines.next().ok_or_else(|| damaged("has no resolution"))?;
        drop(lines);
        for (key, value) in attributes.iter().filter_map(|line| line.split_once('=')) {
            let numbers: Vec<f64> =
                value.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let usable = numbers.iter().all(|number| number.is_finite());
            match (key.trim(), &numbers[..]) {
                ("FORMAT", _) => header.is_xyz = value.contains("xyze"),
                ("EXPOSURE", &[by]) if by > 0.0 && usable => header.exposure *= by,
                ("COLORCORR", &[r, g, b]) if usable && r.min(g).min(b) > 0.0 => {
                    header.correction *= DVec3::new(r, g, b);
                }
                ("PRIMARIES", &[rx, ry, gx, gy, bx, by, wx, wy]) if usable => {
                    let colors = [DVec2::new(rx, ry), DVec2::new(gx, gy), DVec2::new(bx, by)];
                    header.primaries = Some(Primaries { colors, white: DVec2::new(wx, wy) });
                }
                _ => {}
            }
        }
        let words: Vec<&str> = resolution.split_whitespace().collect();
        let &[first, lines, second, length] = &words[..] else {
            return Err(damaged("has a resolution of other than four words"));
        };
        let [lines, length] = [lines, length].map(str::parse::<u32>);
        let (Ok(lines), Ok(length)) = (lines, length) else {
            return Err(damaged("has a resolution of no whole numbers"));
        };
        let forward = |axis: &str, sign: &str| {
            [first, second].iter().any(|word| *word == format!("{sign}{axis}"))
        };
        header.columns = first.ends_with('X');
        header.forward = [forward("X", "+"), forward("Y", "-")];
        let known =
            (forward("X", "+") || forward("X", "-")) && (forward("Y", "+") || forward("Y", "-"));
        if !known {
            return Err(damaged(&format!("has an unknown orientation, {first} {second}")));
        }
        [header.width, header.height] =
            if header.columns { [lines, length] } else { [length, lines] };
        Ok(header)
    }

    /// Rows from the top, of scan lines as the file has them.
    fn upright(&self, scanned: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let [width, height] = [self.width as usize, self.height as usize];
        let from =
            |at: usize, extent: usize, forward: bool| if forward { at } else { extent - 1 - at };
        let pixel = |index: usize| {
            let x = from(index % width, width, self.forward[0]);
            let y = from(index / width, height, self.forward[1]);
            let at = if self.columns { x * height + y } else { y * width + x };
            scanned.get(at).copied().unwrap_or_default()
        };
        (0..width * height).map(pixel).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file of flat pixels: mantissas of 128 under an exponent of 129 are 1.
    fn file(header: &str, pixels: &[[u8; 3]]) -> Vec<u8> {
        let flat = pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 129]);
        header.bytes().chain(flat).collect()
    }

    fn reds(header: &str) -> Vec<u8> {
        let pixels: Vec<[u8; 3]> = (0..6).map(|i| [i, 0, 0]).collect();
        let picture = read(&file(header, &pixels)).unwrap();
        picture.image.pixels.iter().map(|pixel| (pixel[0] * 128.0).round() as u8).collect()
    }

    #[test]
    fn all_orientations_are_upright() {
        let of = |resolution: &str| {
            reds(&format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{resolution}\n"))
        };
        assert_eq!(of("-Y 2 +X 3"), [0, 1, 2, 3, 4, 5]);
        assert_eq!(of("+Y 2 +X 3"), [3, 4, 5, 0, 1, 2]);
        assert_eq!(of("-Y 2 -X 3"), [2, 1, 0, 5, 4, 3]);
        assert_eq!(of("+Y 2 -X 3"), [5, 4, 3, 2, 1, 0]);
        // Columns, 3 of 2 pixels.
        assert_eq!(of("+X 3 -Y 2"), [0, 2, 4, 1, 3, 5]);
        assert_eq!(of("-X 3 -Y 2"), [4, 2, 0, 5, 3, 1]);
        assert_eq!(of("+X 3 +Y 2"), [1, 3, 5, 0, 2, 4]);
        assert_eq!(of("-X 3 +Y 2"), [5, 3, 1, 4, 2, 0]);
        assert!(read(&file("#?RADIANCE\n\n-Z 2 +X 3\n", &[[0; 3]; 6])).is_err());
        assert!(read(b"#?RADIANCE\n\n-Y 2 +X 3").is_err());
        assert!(read(b"#?").is_err());
    }

    #[test]
    fn exposure_and_correction_are_divided_by() {
        let header = "#?RGBE\nEXPOSURE=4\nEXPOSURE= 0.5\nCOLORCORR=1 2 0.5\n\n-Y 1 +X 1\n";
        let picture = read(&file(header, &[[128, 128, 128]])).unwrap();
        assert_eq!(picture.image.pixels, [[0.5, 0.25, 1.0]]);
        assert_eq!(picture.notes.len(), 1);
    }

    #[test]
    fn xyz_becomes_rgb() {
        let header = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
        let picture = read(&file(header, &[[122, 128, 139]])).unwrap();
        let [r, g, b] = picture.image.pixels[0];
        assert!([r, g, b].iter().all(|channel| (channel - 1.0).abs() < 0.02), "{r} {g} {b}");
    }
}
