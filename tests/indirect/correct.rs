//! Corrected visibility: whatever clusters share, the mean over rays is the light of VPLs that every
//! point looks for itself.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use crate::common::{frame, gpu};
use gpu_vpl::render::{Clustering, Direct, Method, Prepared, Settings};
use gpu_vpl::scene::Scene;

/// Rays that corrections draw together.
const BATCH: u32 = 4;
/// Rays of each point, in all.
const RAYS: u32 = 256;
const SIZE: [u32; 2] = [40, 40];

/// So few clusters that what they share is often wrong.
fn settings(method: Method, correct: u32) -> Settings {
    Settings {
        light_paths: 150,
        candidates: 1,
        direct: Direct::Off,
        interleave: 1,
        edge_samples: 1,
        compensate: false,
        correct,
        clustering: Clustering { points: 60, vpls: 30, ..Clustering::default() },
        ..Settings::of(method)
    }
}

/// The mean of the channels of every pixel of the Cornell box.
fn pixels(prepared: &Prepared, method: Method, rays: u32) -> Vec<f64> {
    let image = frame(prepared, &settings(method, rays)).image;
    image.pixels.iter().map(|rgb| rgb.iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0).collect()
}

fn prepare() -> Prepared {
    let mut scene = Scene::load("builtin:cornell").unwrap();
    scene.camera.size = SIZE;
    Prepared::new(gpu().clone(), scene, &settings(Method::Both, BATCH)).unwrap()
}

fn squared_error(image: &[f64], truth: &[f64]) -> f64 {
    let squares = image.iter().zip(truth).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>() / truth.len() as f64
}

/// Every point by its own rays, batch by batch: the sum over the first rays less that over fewer.
fn batches(prepared: &Prepared, method: Method) -> Vec<Vec<f64>> {
    let sum = |rays: u32| -> Vec<f64> {
        let mean = pixels(prepared, method, rays);
        mean.iter().map(|value| value * f64::from(rays / BATCH)).collect()
    };
    let mut before = vec![0.0; (SIZE[0] * SIZE[1]) as usize];
    let numbers = (BATCH..=RAYS).step_by(BATCH as usize);
    let each = numbers.map(|rays| {
        let sum = sum(rays);
        let batch = sum.iter().zip(&before).map(|(now, before)| now - before).collect();
        before = sum;
        batch
    });
    each.collect()
}

#[test]
fn every_pixel_has_the_light_of_its_own_rays() {
    let prepared = prepare();
    let truth = pixels(&prepared, Method::Vpl, 0);
    for method in [Method::Vpc, Method::Both] {
        let shared = pixels(&prepared, method, 0);
        let batches = batches(&prepared, method);
        // Half of 1000 pixels are those where sharing is most wrong: at edges of shadows.
        let mut order: Vec<usize> = (0..truth.len()).filter(|&i| truth[i] > 0.0).collect();
        order.sort_by(|&a, &b| {
            let wrong = |i: usize| (shared[i] - truth[i]).abs();
            wrong(b).total_cmp(&wrong(a))
        });
        let others = order[500..].iter().step_by((order.len() - 500) / 500).take(500);
        let chosen: Vec<usize> = order[..500].iter().chain(others).copied().collect();
        let deviations: Vec<f64> = chosen
            .iter()
            .filter_map(|&pixel| {
                let n = batches.len() as f64;
                let mean = batches.iter().map(|batch| batch[pixel]).sum::<f64>() / n;
                let squares = batches.iter().map(|batch| (batch[pixel] - mean).powi(2));
                let error = (squares.sum::<f64>() / (n * (n - 1.0))).sqrt();
                // Where everything is seen there is nothing to correct, nor any noise.
                (error > 1e-6 * truth[pixel]).then(|| (mean - truth[pixel]) / error)
            })
            .collect();
        let count = deviations.len() as f64;
        assert!(count > 800.0, "{method:?}: only {count} pixels are corrected at all");
        let beyond = deviations.iter().filter(|z| z.abs() > 2.0).count() as f64 / count;
        let mean = deviations.iter().sum::<f64>() / count;
        assert!((0.025..0.085).contains(&beyond), "{method:?}: {beyond} beyond two deviations");
        assert!(mean.abs() < 0.15, "{method:?}: deviations of {mean} in the mean");
    }
}

/// Of more than one chunk of the bit matrix each point corrects some, whose number is right in the mean.
#[test]
fn rays_are_spread_over_many_lights() {
    let prepared = prepare();
    let many = |method, correct| {
        let of = Settings { light_paths: 2000, ..settings(method, correct) };
        let image = frame(&prepared, &of).image;
        image.pixels.iter().map(|rgb| f64::from(rgb[1])).collect::<Vec<_>>()
    };
    let truth = many(Method::Vpl, 0);
    let errors = [0, 1, 16, 256].map(|rays| squared_error(&many(Method::Both, rays), &truth));
    // A single ray has to stand for all chunks at once.
    assert!(errors[1] > 12.0 * errors[2], "{errors:?}");
    let fall = errors[2] / errors[3];
    assert!((12.0..21.0).contains(&fall), "{errors:?}");
    assert!(errors[3] < errors[0], "{errors:?}");
}

#[test]
fn the_error_falls_as_one_over_the_rays() {
    let prepared = prepare();
    let truth = pixels(&prepared, Method::Vpl, 0);
    for method in [Method::Vplc, Method::Vpc, Method::Both] {
        let error = |rays| squared_error(&pixels(&prepared, method, rays), &truth);
        let errors = [4, 16, 64, 256].map(error);
        // Of 64 times as many rays a 64th; that of few pixels is noisy.
        let fall = errors[0] / errors[3];
        assert!((50.0..80.0).contains(&fall), "{method:?}: {errors:?}");
        assert!(errors.is_sorted_by(|a, b| a > b), "{method:?}: {errors:?}");
        let shared = error(0);
        assert!(errors[2] < 0.5 * shared, "{method:?}: 64 rays leave {} of {shared}", errors[2]);
    }
}
