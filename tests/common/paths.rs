//! Frames of the path tracer, and their error.

use gpu_vpl::image::Image;
use gpu_vpl::render::{self, Bounces, Frame, Method, Prepared, Settings};
use gpu_vpl::scene::Scene;

use super::gpu;

pub fn settings(samples: u32, bounces: Bounces) -> Settings {
    Settings { samples, bounces, ..Settings::of(Method::Path) }
}

pub fn frame(prepared: &Prepared, settings: &Settings, seed: u32) -> Frame {
    let camera = prepared.scene.camera;
    render::frame(prepared, &camera, settings, seed, &|_, _| {}).unwrap()
}

pub fn prepare(scene: Scene, settings: &Settings) -> Prepared {
    Prepared::new(gpu().clone(), scene, settings).unwrap()
}

/// Mean of a channel over the image, and its standard error.
pub fn mean_and_error(frame: &Frame, channel: usize) -> (f64, f64) {
    let n = frame.image.pixels.len() as f64;
    let sum = |image: &Image, power: i32| -> f64 {
        image.pixels.iter().map(|pixel| f64::from(pixel[channel]).powi(power)).sum()
    };
    let error = frame.standard_error.as_ref().map_or(0.0, |error| sum(error, 2).sqrt() / n);
    (sum(&frame.image, 1) / n, error)
}
