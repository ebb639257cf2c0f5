//! Random numbers of the shapes that break things: of every magnitude, and often exactly the ends.

use glam::{DVec3, dvec3};

use super::common::Rng;

/// True in so many of a hundred cases.
pub fn percent(rng: &mut Rng, percents: usize) -> bool {
    rng.below(100) < percents
}

pub fn between(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * f64::from(rng.unit())
}

/// Of any magnitude between the two.
pub fn magnitude(rng: &mut Rng, low: f64, high: f64) -> f64 {
    between(rng, low.ln(), high.ln()).exp()
}

/// A count of any magnitude between the two, both included.
pub fn count(rng: &mut Rng, low: u32, high: u32) -> u32 {
    let any = magnitude(rng, f64::from(low.max(1)), f64::from(high) + 0.99) as u32;
    if low == 0 && percent(rng, 10) { 0 } else { any.min(high) }
}

pub fn pick<T: Copy>(rng: &mut Rng, of: &[T]) -> T {
    of[rng.below(of.len())]
}

/// A place in [-1, 1]³, at times on the axes or at the origin itself.
pub fn place(rng: &mut Rng) -> DVec3 {
    let any = rng.cube().as_dvec3();
    match rng.below(12) {
        0 => DVec3::ZERO,
        1 => any * DVec3::X,
        2 => any.round(),
        3 => any * magnitude(rng, 1e-30, 1.0),
        _ => any,
    }
}

/// A direction of some length, at times along an axis.
pub fn direction(rng: &mut Rng) -> DVec3 {
    let any = rng.direction().as_dvec3();
    match rng.below(4) {
        0 => pick(rng, &[DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z]),
        _ => any * magnitude(rng, 1e-3, 1e3),
    }
}

/// Reflectances of 0, of 1, and between.
pub fn reflectance(rng: &mut Rng) -> [f64; 3] {
    match rng.below(6) {
        0 => [0.0; 3],
        1 => [1.0; 3],
        2 => [0.999; 3],
        _ => [0; 3].map(|_| between(rng, 0.0, 1.0)),
    }
}

/// Radiance or the like over twelve orders of magnitude, some channels black.
pub fn power(rng: &mut Rng) -> [f64; 3] {
    let most = magnitude(rng, 1e-6, 1e6);
    let all = [0; 3].map(|_| most * between(rng, 0.0, 1.0));
    let some = dvec3(1.0, f64::from(rng.bits() & 1), f64::from(rng.bits() & 1));
    match rng.below(3) {
        0 => (DVec3::from_array(all) * some).to_array(),
        1 => [most; 3],
        _ => all,
    }
}
