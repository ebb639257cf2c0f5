//! The images that total errors are against: the path tracer's, rendered once, or a given one.

use std::path::Path;

use super::measure::{Bench, Lens, Measured};
use super::plan::Transport;
use super::results::{self, Noise};
use super::store::{Store, hash_of_image, name_of};
use super::{Event, Tell, options};
use crate::error::Error;
use crate::image::{Image, ImageError, read};
use crate::metrics::away_from_bright;
use crate::render::{Bounces, Settings};

/// An image to compare with, and what is known of it.
#[derive(Debug)]
pub struct Reference {
    /// What light it holds; none is any.
    pub transport: Option<Transport>,
    /// The image.
    pub image: Image,
    /// How others are compared with it.
    pub lens: Lens,
    /// What tells it from others in the keys of measurements.
    pub identity: String,
    /// For tables and pages.
    pub about: results::Reference,
}

/// What all references of a scene share.
#[derive(Debug, Clone, Copy)]
pub struct Making<'a> {
    /// The scene's key in the store.
    pub key: &'a str,
    /// The scene's name.
    pub scene: &'a str,
    /// Pixels near any brighter than this are left out of all errors.
    pub mask_above: Option<f64>,
    /// At which FLIP looks.
    pub exposure: f32,
}

/// Independent images whose mean the reference is; what they differ by is its standard error.
const PASSES: u32 = 16;
/// Seeds of passes begin here, far from those of rows.
const FIRST_SEED: u32 = 0x5eed_0000;
/// A given reference is checked against an image of so many samples in all, so that its mean is
/// known to about a part in a thousand; of a pixel at least, and at most, so many.
const CHECK_SAMPLES: u32 = 1 << 22;
const CHECK_LEAST_SAMPLES: u32 = 64;
const CHECK_MOST_SAMPLES: u32 = 4096;
/// It is said to be too bright, or too dark, from so many standard errors on, and from so much.
const CHECK_ERRORS: f64 = 4.0;
const CHECK_LEAST: f64 = 0.002;

/// The path tracer's image, of at least so many samples, from the store as far as it is there.
///
/// # Errors
/// The device fails, the disk is full, or the user interrupts.
pub fn rendered(
    bench: &mut Bench<'_>,
    store: &mut Store,
    making: Making<'_>,
    transport: Transport,
    samples: u32,
    tell: Tell<'_>,
) -> Result<Reference, Error> {
    let each = samples.div_ceil(PASSES).max(2);
    let mut settings = transport.reference(each);
    let (mut sums, seconds, mut warnings) = passes(bench, store, making, &settings, tell)?;
    let (image, variance) = sums.finish();
    let broken = image.pixels.iter().filter(|pixel| !pixel.iter().all(|c| c.is_finite())).count();
    if broken > 0 {
        warnings.push(format!("{broken} pixels of the reference are not finite"));
    }
    let lens = lens(&image, making);
    let noise = noise(&image, &variance, &lens.keep);
    settings.samples = each * PASSES;
    let about = results::Reference {
        id: String::new(),
        label: format!("path, {} samples, {}", settings.samples, label(transport)),
        command: Some(options::command(making.scene, &settings, bench.camera.size, 0)),
        samples: Some(settings.samples),
        seconds: Some(seconds),
        mean: mean(&image, &lens.keep),
        noise: Some(noise),
        warnings,
        image: None,
    };
    let identity = hash_of_image(&image);
    Ok(Reference { transport: Some(transport), image, lens, identity, about })
}

/// A given image, checked: its size, its pixels, and its brightness against a path tracer's.
///
/// # Errors
/// It cannot be read, does not fit, or the device fails.
pub fn given(
    bench: &mut Bench<'_>,
    store: &mut Store,
    making: Making<'_>,
    transport: Transport,
    file: &Path,
    tell: Tell<'_>,
) -> Result<Reference, Error> {
    let image = read(file)?;
    let [width, height] = bench.camera.size;
    if [image.width, image.height] != [width, height] {
        let what = format!(
            "it is {} x {} pixels, but the study renders {width} x {height}; give a reference of \
             that size, or --size {}x{}",
            image.width, image.height, image.width, image.height
        );
        return Err(ImageError::new(file, what).into());
    }
    if let Some([x, y]) = image.first_nonfinite() {
        let what = format!("pixel ({x}, {y}) is not finite; nothing can be compared with that");
        return Err(ImageError::new(file, what).into());
    }
    let samples = CHECK_SAMPLES / (width.saturating_mul(height));
    let samples = samples.clamp(CHECK_LEAST_SAMPLES, CHECK_MOST_SAMPLES);
    let check = rendered(bench, store, making, transport, samples, tell)?;
    let lens = lens(&image, making);
    let mut warnings = check.about.warnings.clone();
    warnings.extend(brightness(&image, &check, &lens.keep).map(|what| {
        let label = label(transport);
        format!("{}: {what} ({label}); check how it was made", file.display())
    }));
    let about = results::Reference {
        id: String::new(),
        label: file.display().to_string(),
        command: None,
        samples: None,
        seconds: None,
        mean: mean(&image, &lens.keep),
        noise: None,
        warnings,
        image: None,
    };
    let identity = hash_of_image(&image);
    Ok(Reference { transport: None, image, lens, identity, about })
}

/// What is wrong with an image's brightness, beside the path tracer's.
fn brightness(image: &Image, check: &Reference, keep: &[bool]) -> Option<String> {
    let expected = mean(&check.image, keep);
    let noise = check.about.noise?;
    let kept = keep.iter().filter(|keep| **keep).count() as f64;
    // The noise of pixels is independent.
    let error = noise.rmse / (3.0 * kept).sqrt() / expected;
    let bias = mean(image, keep) / expected - 1.0;
    let word = if bias > 0.0 { "brighter" } else { "darker" };
    (bias.is_nan() || bias.abs() > CHECK_LEAST.max(CHECK_ERRORS * error)).then(|| {
        format!(
            "it is {:.2} % {word} than the path tracer's image of the same light (± {:.2} %)",
            100.0 * bias.abs(),
            100.0 * error
        )
    })
}

/// Renders what is not in the store yet.
fn passes(
    bench: &mut Bench<'_>,
    store: &mut Store,
    making: Making<'_>,
    settings: &Settings,
    tell: Tell<'_>,
) -> Result<(Sums, f64, Vec<String>), Error> {
    let mut sums = Sums::default();
    let mut seconds = 0.0;
    let mut changed = 0;
    for pass in 0..PASSES {
        let key = format!("{} pass {pass} {}", making.key, options::all(settings));
        let name = name_of(&key);
        let kept = store.get(&key).cloned().filter(|_| store.has_image(&name));
        let image = kept.as_ref().and_then(|_| store.image(&name));
        changed += u32::from(kept.is_some() && image.is_none());
        let (image, measured) = match (image, kept) {
            (Some(image), Some(measured)) => (image, measured),
            _ => {
                let (frame, times) = bench.frame(settings, FIRST_SEED + pass)?;
                let measured = Measured { times, counts: frame.counts, ..Measured::default() };
                store.put_image(&name, &frame.image)?;
                store.put(&key, measured.clone())?;
                tell(Event::Pass {
                    scene: making.scene,
                    done: pass + 1,
                    passes: PASSES,
                    seconds: times.seconds,
                });
                (frame.image, measured)
            }
        };
        seconds += measured.times.seconds;
        sums.add(image);
    }
    let warning = (changed > 0).then(|| {
        let scene = making.scene;
        format!("{changed} of {PASSES} parts of the reference of {scene} were changed on disk; they are rendered anew")
    });
    Ok((sums, seconds, warning.into_iter().collect()))
}

/// Sums over passes, of each channel of each pixel.
#[derive(Debug, Default)]
struct Sums {
    count: f64,
    size: [u32; 2],
    first: Vec<f64>,
    second: Vec<f64>,
}

impl Sums {
    fn add(&mut self, image: Image) {
        let values = image.pixels.as_flattened();
        self.first.resize(values.len(), 0.0);
        self.second.resize(values.len(), 0.0);
        for ((first, second), value) in self.first.iter_mut().zip(&mut self.second).zip(values) {
            *first += f64::from(*value);
            *second += f64::from(*value).powi(2);
        }
        self.count += 1.0;
        self.size = [image.width, image.height];
    }

    /// The mean image, and the variance of each of its channels.
    fn finish(&mut self) -> (Image, Vec<f64>) {
        let n = self.count;
        let pixels = self.first.chunks_exact(3).map(|sum| [0, 1, 2].map(|c| (sum[c] / n) as f32));
        let variances = self.first.iter().zip(&self.second).map(|(first, second)| {
            let scatter = (second - first * first / n).max(0.0) / (n - 1.0);
            scatter / n
        });
        let [width, height] = self.size;
        (Image { width, height, pixels: pixels.collect() }, variances.collect())
    }
}

fn lens(reference: &Image, making: Making<'_>) -> Lens {
    let keep = match making.mask_above {
        Some(level) => away_from_bright(reference, level),
        None => vec![true; reference.pixels.len()],
    };
    Lens { keep, exposure: making.exposure }
}

/// The mean of all channels of the pixels to keep.
fn mean(image: &Image, keep: &[bool]) -> f64 {
    let kept = || image.pixels.iter().zip(keep).filter(|(_, keep)| **keep);
    let sum: f64 = kept().flat_map(|(pixel, _)| pixel.map(f64::from)).sum();
    sum / (3 * kept().count()) as f64
}

/// The errors of a perfect image against one whose channels have these variances.
fn noise(image: &Image, variance: &[f64], keep: &[bool]) -> Noise {
    const TILE: usize = 16;
    let mean = mean(image, keep);
    let floor = 0.01 * mean * mean;
    let (width, height) = (image.width as usize, image.height as usize);
    let kept = |index: usize| keep[index / 3];
    let all = || (0..variance.len()).filter(|index| kept(*index));
    let count = all().count() as f64;
    let rmse = (all().map(|index| variance[index]).sum::<f64>() / count).sqrt();
    let values = image.pixels.as_flattened();
    let relative = |index: usize| variance[index] / (f64::from(values[index]).powi(2) + floor);

    let (mut tiles, mut squares) = (0.0, 0.0);
    for (x, y) in (0..height / TILE).flat_map(|y| (0..width / TILE).map(move |x| (x, y))) {
        let pixels = (0..TILE * TILE).map(|i| (y * TILE + i / TILE) * width + x * TILE + i % TILE);
        let pixels: Vec<_> = pixels.filter(|pixel| keep[*pixel]).collect();
        if pixels.is_empty() {
            continue;
        }
        let sum: f64 = pixels.iter().flat_map(|pixel| &variance[3 * pixel..3 * pixel + 3]).sum();
        tiles += 3.0;
        squares += sum / (pixels.len() * pixels.len()) as f64;
    }
    Noise {
        rmse,
        nrmse: rmse / mean,
        relmse: all().map(relative).sum::<f64>() / count,
        tile_nrmse: (tiles > 0.0).then(|| f64::sqrt(squares / tiles) / mean),
    }
}

fn label(transport: Transport) -> String {
    let bounces = match transport.bounces {
        Bounces::Finite(1) => "1 bounce".to_owned(),
        bounces => format!("{} bounces", options::bounces(bounces)),
    };
    if transport.direct { bounces } else { format!("{bounces}, indirect light alone") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(values: &[f32]) -> Image {
        let pixels = values.iter().map(|value| [*value; 3]).collect();
        Image { width: values.len() as u32, height: 1, pixels }
    }

    #[test]
    fn passes_give_a_mean_and_its_variance() {
        let mut sums = Sums::default();
        for values in [[1.0, 5.0], [3.0, 5.0], [1.0, 5.0], [3.0, 5.0]] {
            sums.add(image(&values));
        }
        let (mean, variance) = sums.finish();
        assert_eq!(mean, image(&[2.0, 5.0]));
        // Scatter 4/3 of single passes, over 4 of them.
        assert!((variance[0] - 1.0 / 3.0).abs() < 1e-12 && variance[3] == 0.0);
        let noise = noise(&mean, &variance, &[true, true]);
        assert!((noise.rmse - (1.0f64 / 6.0).sqrt()).abs() < 1e-12);
        assert_eq!(noise.tile_nrmse, None);
        assert!((noise.nrmse - noise.rmse / 3.5).abs() < 1e-12);
    }
}
