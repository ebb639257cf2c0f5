//! Figures as checks make them, frames as they render them.

use crate::error::Error;
use crate::extremes::Figure;
use crate::gpu::Gpu;
use crate::metrics::largest;
use crate::render::{self, Frame, Method, Prepared, Settings};
use crate::scene::Scene;

/// The methods that gather indirect light from VPLs.
pub const GATHERING: [Method; 4] = [Method::Vpl, Method::Vplc, Method::Vpc, Method::Both];

/// A figure that may be off by so much.
pub fn absolute(what: impl Into<String>, expected: f64, measured: f64, within: f64) -> Figure {
    let error = (measured - expected).abs();
    Figure { method: String::new(), what: what.into(), expected, measured, error, within }
}

/// A figure that may be off by such a share of what it must be.
pub fn relative(what: impl Into<String>, expected: f64, measured: f64, within: f64) -> Figure {
    let error = (measured / expected - 1.0).abs();
    Figure { method: String::new(), what: what.into(), expected, measured, error, within }
}

/// A count of what must not be.
pub fn none(what: impl Into<String>, count: usize) -> Figure {
    absolute(what, 0.0, count as f64, 0.0)
}

/// An error that may be so large.
pub fn at_most(what: impl Into<String>, error: f64, within: f64) -> Figure {
    absolute(what, 0.0, error, within)
}

/// The same figure, of a method.
pub fn of(method: Method, figure: Figure) -> Figure {
    Figure { method: method.name().to_owned(), ..figure }
}

/// The device, and the same without subgroups where it has them: each with the name of its kernels.
pub fn devices(gpu: &Gpu) -> Vec<(&'static str, Gpu)> {
    let plain = ("plain", gpu.clone().without_subgroups());
    match gpu.has_subgroups() {
        true => vec![("cooperative", gpu.clone()), plain],
        false => vec![plain],
    }
}

/// A frame of a scene by itself.
///
/// # Errors
/// The device fails.
pub fn frame(gpu: &Gpu, scene: Scene, settings: &Settings) -> Result<Frame, Error> {
    frame_of(&Prepared::new(gpu.clone(), scene, settings)?, settings)
}

/// A frame of a prepared scene.
///
/// # Errors
/// The device fails.
pub fn frame_of(prepared: &Prepared, settings: &Settings) -> Result<Frame, Error> {
    frame_seeded(prepared, settings, 1)
}

/// A frame of other random numbers.
///
/// # Errors
/// The device fails.
pub fn frame_seeded(prepared: &Prepared, settings: &Settings, seed: u32) -> Result<Frame, Error> {
    let camera = prepared.scene.camera;
    Ok(render::frame(prepared, &camera, settings, seed, &|_, _| {})?)
}

/// The largest difference of two images over the mean of the second.
pub fn difference(one: &Frame, two: &Frame) -> f64 {
    let values = |frame: &Frame| frame.image.pixels.clone().into_iter().flatten().map(f64::from);
    let mean = values(two).map(f64::abs).sum::<f64>() / values(two).count() as f64;
    let most = largest(values(one).zip(values(two)).map(|(a, b)| (a - b).abs()));
    // Of two black images there is nothing to compare.
    if mean > 0.0 { most / mean } else { f64::NAN }
}

/// The sum of all channels of all pixels.
pub fn energy(frame: &Frame) -> f64 {
    frame.image.pixels.iter().flatten().map(|&value| f64::from(value)).sum()
}
