//! Error against the number of VPLs, and so against run time: printed as a table by
//!
//! ```text
//! cargo test --release --test indirect convergence -- --nocapture
//! ```

#![expect(clippy::print_stdout, clippy::unwrap_used, reason = "a test whose output is a table")]

use std::time::Instant;

use gpu_vpl::gpu::{AdapterChoice, Gpu};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Clamp, Direct, Frame, Method, Prepared, Settings, frame};
use gpu_vpl::scene::{Camera, Scene};

const SIZE: u32 = 32;
/// Independent VPL sets a row.
const SEEDS: u32 = 5;
/// Sixteen times the paths of the last row: its own error is a few per cent of that row's.
const REFERENCE_PATHS: u32 = 65_536;

/// Mean squared error relative to the squared mean, and relative error of the mean.
fn errors(image: &Image, reference: &Image) -> (f64, f64) {
    let (mut square, mut difference, mut sum) = (0.0, 0.0, 0.0);
    for (a, b) in image.pixels.iter().flatten().zip(reference.pixels.iter().flatten()) {
        let (a, b) = (f64::from(*a), f64::from(*b));
        square += (a - b).powi(2);
        difference += a - b;
        sum += b;
    }
    let count = (3 * image.pixels.len()) as f64;
    (square / count / (sum / count).powi(2), difference / sum)
}

/// Slope of a straight line through points, by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
    let top: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    top / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// Renders the indirect light of the Cornell box in many settings.
struct Cornell {
    prepared: Prepared,
    camera: Camera,
}

impl Cornell {
    fn new() -> Self {
        let scene = Scene::load("builtin:cornell").unwrap();
        let mut camera = scene.camera;
        camera.size = [SIZE; 2];
        let gpu = Gpu::open(&AdapterChoice::Auto).unwrap();
        let prepared = Prepared::new(gpu, scene, &Settings::default()).unwrap();
        Self { prepared, camera }
    }

    /// The frame, without the light itself: emission is not what converges.
    fn render(&self, light_paths: u32, clamp: Clamp, seed: u32) -> Frame {
        // One point a pixel: no pixel mixes a wall with the lamp, which is masked.
        let settings = Settings {
            light_paths,
            clamp,
            direct: Direct::Off,
            edge_samples: 1,
            ..Settings::of(Method::Vpl)
        };
        let mut frame = frame(&self.prepared, &self.camera, &settings, seed, &|_, _| {}).unwrap();
        for pixel in &mut frame.image.pixels {
            if pixel[0] > 5.0 {
                *pixel = [0.0; 3];
            }
        }
        frame
    }

    /// Prints a row for each number of paths. Returns the slope of log error over log paths,
    /// and the last row's bias.
    fn sweep(&self, title: &str, clamp: Clamp) -> (f64, f64) {
        let reference = self.render(REFERENCE_PATHS, clamp, 1000).image;
        println!("\n{title}\n");
        println!("| light paths | VPLs | seconds | nRMSE | bias | clamped |");
        println!("| ---: | ---: | ---: | ---: | ---: | ---: |");
        let mut rows = Vec::new();
        let mut last_bias = 0.0;
        for paths in [64, 256, 1024, 4096] {
            let (mut square, mut bias, mut clamped, mut vpls) = (0.0, 0.0, 0.0, 0);
            let start = Instant::now();
            for seed in 0..SEEDS {
                let result = self.render(paths, clamp, seed);
                let (error, shift) = errors(&result.image, &reference);
                square += error / f64::from(SEEDS);
                bias += shift / f64::from(SEEDS);
                clamped += result.counts.clamped_fraction / f64::from(SEEDS);
                vpls += result.counts.vpls / u64::from(SEEDS);
            }
            let seconds = start.elapsed().as_secs_f64() / f64::from(SEEDS);
            let nrmse = square.sqrt();
            let (percent, clamped) = (100.0 * bias, 100.0 * clamped);
            println!(
                "| {paths} | {vpls} | {seconds:.3} | {nrmse:.3} | {percent:+.1} % | {clamped:.1} % |"
            );
            rows.push((f64::from(paths).ln(), nrmse.ln()));
            last_bias = bias;
        }
        let slope = slope(&rows);
        println!("\nslope of log nRMSE over log paths: {slope:.2}");
        (slope, last_bias)
    }
}

#[test]
fn indirect_light_converges_with_the_number_of_light_paths() {
    let cornell = Cornell::new();
    // The default bound grows with the VPLs, and lets the corners' splotches shrink with it
    // instead of fading: slower than -1/2, but to the right image.
    let (slope, bias) = cornell.sweep("The default clamp:", Clamp::Auto);
    assert!(slope < -0.25, "{slope}");
    assert!(bias.abs() < 0.02, "{bias}");
    // With a fixed bound on both sides it is an integral like any other: -1/2 for Monte
    // Carlo, and a little better for a low-discrepancy sequence.
    let bound = cornell.render(256, Clamp::Auto, 0).counts.clamp.unwrap();
    let (slope, bias) = cornell.sweep("A fixed clamp, for both sides:", Clamp::At(bound));
    assert!(slope < -0.45, "{slope}");
    assert!(bias.abs() < 0.01, "{bias}");
}
