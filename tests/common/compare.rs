//! Image comparison: how far a pixel may be off, and how many pixels may be further off, are
//! two things. References are EXR files; a missing one is a failure, unless it is to be
//! written (`GPU_VPL_BLESS=1`).

use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use gpu_vpl::image::Image;
use gpu_vpl::image::exr::{Plane, write};

/// What two images may differ by.
#[derive(Debug, Clone, Copy)]
pub struct Tolerance {
    /// Of a channel, relative to the larger of the two values.
    pub relative: f32,
    /// Of a channel, where both values are small.
    pub absolute: f32,
    /// How many pixels may be off by more.
    pub pixels: usize,
}

/// Whether images agree; else how they differ.
pub fn compare(expected: &Image, actual: &Image, tolerance: Tolerance) -> Result<(), String> {
    let size = |image: &Image| (image.width, image.height, image.pixels.len());
    if size(expected) != size(actual) {
        return Err(format!("{:?} instead of {:?} pixels", size(actual), size(expected)));
    }
    if expected.pixels.is_empty() {
        return Err("no pixels: nothing was compared".to_owned());
    }
    // In units of the tolerance: an error of 1 is just allowed. A NaN is beyond everything.
    let error = |(&a, &b): (&f32, &f32)| {
        let allowed = tolerance.absolute.max(tolerance.relative * a.abs().max(b.abs()));
        let error = (a - b).abs() / allowed;
        if error.is_nan() { f32::INFINITY } else { error }
    };
    let pairs = expected.pixels.iter().zip(&actual.pixels);
    let errors: Vec<f32> =
        pairs.map(|(a, b)| a.iter().zip(b).map(error).fold(0.0, f32::max)).collect();
    let failing = errors.iter().filter(|&&error| error > 1.0).count();
    if failing <= tolerance.pixels {
        return Ok(());
    }
    let mut report = format!("{failing} pixels of {} fail ({tolerance:?});", errors.len());
    let worst = errors.iter().copied().fold(0.0, f32::max);
    let at = errors.iter().position(|&error| error == worst).unwrap_or(0);
    let [x, y] = [at % expected.width as usize, at / expected.width as usize];
    report += &format!(
        " the worst at ({x}, {y}): {:?} instead of {:?}\nerror / tolerance: pixels",
        actual.pixels[at], expected.pixels[at]
    );
    let mut low = 0.0;
    for high in [1e-3, 0.01, 0.1, 1.0, 10.0, 100.0, 1e3, f32::INFINITY] {
        let count = errors.iter().filter(|&&e| (low <= e && e < high) || e == high).count();
        report += &format!("\n  {low:>5} to {high:>5}: {count}");
        low = high;
    }
    Err(report)
}

/// The folder of the references.
pub fn references() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden")
}

/// Compares with the reference `name`.exr in a folder; where they differ, leaves both images
/// and their difference in the target directory. With `bless`, writes the reference instead.
pub fn check(
    folder: &Path,
    name: &str,
    actual: &Image,
    tolerance: Tolerance,
    bless: bool,
) -> Result<(), String> {
    let file = folder.join(format!("{name}.exr"));
    if bless {
        save(&file, actual);
        return Ok(());
    }
    if !file.exists() {
        return Err(format!("{name}: no {}; GPU_VPL_BLESS=1 writes it", file.display()));
    }
    let expected = load(&file);
    compare(&expected, actual, tolerance).map_err(|difference| {
        let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join("images");
        save(&left.join(format!("{name}.actual.exr")), actual);
        if expected.pixels.len() == actual.pixels.len() {
            let pairs = expected.pixels.iter().zip(&actual.pixels);
            let pixels = pairs.map(|(a, b)| [0, 1, 2].map(|c| (a[c] - b[c]).abs())).collect();
            let image = Image { pixels, ..*actual };
            save(&left.join(format!("{name}.difference.exr")), &image);
        }
        format!("{name}: {difference}\nimages are in {}", left.display())
    })
}

pub fn save(file: &Path, image: &Image) {
    fs::create_dir_all(file.parent().expect("a file in a folder")).unwrap();
    let mut out = BufWriter::new(File::create(file).unwrap());
    let plane = Plane { layer: "", channels: "RGB", image };
    write(&mut out, &[plane], &Vec::new()).unwrap();
}

pub fn load(file: &Path) -> Image {
    use exr::prelude::*;
    let read = read_first_rgba_layer_from_file(
        file,
        |size, _| (size.0, vec![[0.0; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.1 * *width + at.0] = [r, g, b];
        },
    )
    .unwrap();
    let Vec2(width, height) = read.layer_data.size;
    let pixels = read.layer_data.channel_data.pixels.1;
    gpu_vpl::image::Image { width: width as u32, height: height as u32, pixels }
}
