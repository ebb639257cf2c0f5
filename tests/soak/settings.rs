//! Random settings of a frame, whatever the command line lets through.

use gpu_vpl::render::{
    Bounces, Clamp, Clustering, Direct, Merge, Method, Representative, Settings,
};
use gpu_vpl::scene::Camera;

use super::common::Rng;
use super::random::{between, count, magnitude, percent, pick};

/// Pairs of points and VPLs in a frame, at most: some seconds on one slow core.
const MOST_PAIRS: u64 = 20_000_000;

/// An image of some odd size. The angle of view varies about the scene's.
pub fn camera(rng: &mut Rng, of_scene: &Camera) -> Camera {
    let size = match rng.below(8) {
        0 => [1, 1],
        1 => [1, count(rng, 1, 48)],
        _ => [count(rng, 1, 64), count(rng, 1, 48)],
    };
    let fov = if percent(rng, 20) { magnitude(rng, 1e-3, 179.0) } else { of_scene.fov };
    Camera { size, fov, ..*of_scene }
}

/// Settings of a method for an image of so many pixels of a scene of this scale.
pub fn settings(rng: &mut Rng, method: Method, pixels: u32, scale: f64) -> Settings {
    let path = method == Method::Path;
    let samples = if percent(rng, 50) { 1 } else { count(rng, 1, if path { 16 } else { 4 }) };
    let bounces = match rng.below(4) {
        0 => Bounces::Unlimited,
        1 => Bounces::Finite(count(rng, 0, 50)),
        _ => Bounces::Finite(rng.below(4) as u32),
    };
    // Roulette lets a path live for 20 bounces on average, at most.
    let depth = match bounces {
        Bounces::Unlimited => 20,
        Bounces::Finite(bounces) => bounces.max(1),
    };
    let most_paths = MOST_PAIRS / u64::from(depth * pixels * samples);
    let light_paths = count(rng, 1, (most_paths as u32).clamp(1, 2000));
    let directs = if method.clusters_points() { 4 } else { 3 };
    let direct = [Direct::PerPixel, Direct::PerPixel, Direct::Off, Direct::Clustered];
    Settings {
        light_paths,
        bounces,
        direct: direct[rng.below(directs)],
        light_samples: (!path && percent(rng, 40)).then(|| count(rng, 1, 64)),
        clamp: match rng.below(3) {
            0 => Clamp::Auto,
            1 => Clamp::Off,
            _ => Clamp::At(magnitude(rng, 1e-6, 1e6) / (scale * scale)),
        },
        samples,
        compensate: percent(rng, 50),
        edge_samples: count(rng, 1, 64),
        clustering: clustering(rng),
        candidates: if percent(rng, 50) { 1 } else { count(rng, 1, 16) },
        interleave: if percent(rng, 50) { 1 } else { count(rng, 1, Settings::MOST_INTERLEAVE) },
        ..Settings::of(method)
    }
}

fn clustering(rng: &mut Rng) -> Clustering {
    Clustering {
        points: count(rng, 1, 5000),
        vpls: count(rng, 1, 5000),
        point_iterations: count(rng, 1, 10),
        vpl_iterations: count(rng, 1, 10),
        normal_threshold: between(rng, -1.0, 0.9999) as f32,
        stride: count(rng, 1, 32),
        fuzzy: 1 + rng.below(Clustering::MOST_FUZZY as usize) as u32,
        probes: rng.below(1 + Clustering::MOST_PROBES as usize) as u32,
        representative: pick(rng, &[Representative::Mean, Representative::Member]),
        merge: pick(rng, &[Merge::Light, Merge::Visibility]),
    }
}
