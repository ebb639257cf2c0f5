//! The path tracer against itself, in other samples, waves and traversals, and against the other
//! methods.

#![expect(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use crate::common::paths::{frame, mean_and_error, prepare, settings};
use crate::common::{gpu, room};
use glam::DVec3;
use gpu_vpl::image::Image;
use gpu_vpl::render::{Bounces, Clamp, Method, Prepared, Settings};
use gpu_vpl::scene::Scene;

/// The same light as the other methods compute: direct light alone, and all of it by unclamped
/// VPLs.
#[test]
fn other_methods_agree() {
    let scene = || room(1.0, DVec3::ZERO, [24, 24]).scene();
    let path = settings(1024, Bounces::Finite(0));
    let prepared = prepare(scene(), &path);
    // With as many visible points, spread over the pixels alike.
    let many = Settings {
        samples: 64,
        light_samples: Some(64),
        edge_samples: 1,
        ..Settings::of(Method::Direct)
    };
    for (bounces, other) in [
        (0, many),
        (
            2,
            Settings {
                method: Method::Vpl,
                light_paths: 4000,
                clamp: Clamp::Off,
                samples: 16,
                light_samples: Some(64),
                ..many
            },
        ),
    ] {
        let bounces = Bounces::Finite(bounces);
        let path = frame(&prepared, &Settings { bounces, ..path }, 1);
        let other = frame(&prepared, &Settings { bounces, ..other }, 1);
        for channel in 0..3 {
            let (mean, error) = mean_and_error(&path, channel);
            let (expected, _) = mean_and_error(&other, channel);
            // VPLs in corners have heavy tails: 4000 paths are off by some 0.2 %.
            let most = 4.0 * error + if bounces == Bounces::Finite(0) { 1e-3 } else { 0.01 } * mean;
            let off = mean - expected;
            assert!(off.abs() < most, "{bounces:?}, {channel}: {mean} and {expected}, ± {error}");
        }
    }
}

/// The Cornell box in a small picture.
fn cornell(size: u32) -> Prepared {
    let mut scene = Scene::load("builtin:cornell").unwrap();
    scene.camera.size = [size; 2];
    prepare(scene, &settings(4, Bounces::Unlimited))
}

/// Pixels of the lamp are constant: of no interest, and of a radiance that hides the others.
fn dim(image: &Image) -> impl Iterator<Item = (usize, [f64; 3])> {
    let dim = |pixel: &[f32; 3]| pixel.iter().all(|&c| c < 5.0).then(|| pixel.map(f64::from));
    image.pixels.iter().enumerate().filter_map(move |(at, pixel)| Some((at, dim(pixel)?)))
}

/// Error over samples falls faster than by the rate of Monte Carlo, and the standard error that a
/// frame reports is that of the frames of other seeds, or a little more.
#[test]
fn convergence_and_the_standard_error() {
    const SEEDS: u32 = 12;
    let prepared = cornell(16);
    let reference = frame(&prepared, &settings(4096, Bounces::Unlimited), 1000);
    let mut points = Vec::new();
    for samples in [4, 16, 64, 256] {
        let (mut square, mut reported, mut count) = (0.0, 0.0, 0.0);
        for seed in 0..SEEDS {
            let frame = frame(&prepared, &settings(samples, Bounces::Unlimited), seed);
            let error = frame.standard_error.unwrap();
            for (at, expected) in dim(&reference.image) {
                let found = frame.image.pixels[at].iter().zip(&error.pixels[at]);
                for ((&got, &error), expected) in found.zip(expected) {
                    square += (f64::from(got) - expected).powi(2);
                    reported += f64::from(error).powi(2);
                    count += 1.0;
                }
            }
        }
        let (rmse, reported) = ((square / count).sqrt(), (reported / count).sqrt());
        // The standard error takes stratified samples for independent ones: the more there are,
        // the better they are than that.
        let (ratio, most) = (reported / rmse, f64::from(samples).powf(0.25));
        assert!((0.97..most).contains(&ratio), "{samples} samples: {reported} for {rmse}");
        points.push((f64::from(samples).ln(), rmse.ln()));
    }
    let slope = slope(&points);
    assert!((-1.0..-0.5).contains(&slope), "slope {slope} of {points:?}");
}

/// Slope of a straight line through points, by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
    let top: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    top / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// Two kinds of traversal, one image.
#[test]
fn adapters_without_subgroups_render_the_same() {
    let settings = settings(16, Bounces::Unlimited);
    let scene = || room(1.0, DVec3::ZERO, [24, 24]).scene();
    let packets = frame(&prepare(scene(), &settings), &settings, 1);
    let plain = Prepared::new(gpu().clone().without_subgroups(), scene(), &settings).unwrap();
    let single = frame(&plain, &settings, 1);
    // A ray through an edge may meet the other triangle.
    let differ =
        packets.image.pixels.iter().zip(&single.image.pixels).filter(|(a, b)| {
            a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 1e-5 * b.abs().max(1e-3))
        });
    let differ = differ.count();
    assert!(differ <= 2, "{differ} pixels differ");
}

#[test]
fn seeds_differ_and_repeat() {
    let prepared = cornell(16);
    let settings = settings(4, Bounces::Finite(2));
    let [one, again, other] = [5, 5, 6].map(|seed| frame(&prepared, &settings, seed));
    assert_eq!(one.image, again.image);
    assert_eq!(one.standard_error, again.standard_error);
    assert_eq!(one.counts, again.counts);
    let same = one.image.pixels.iter().zip(&other.image.pixels).filter(|(a, b)| a == b).count();
    assert!(same < 16, "{same} pixels of 256 are the same");
}

/// What the path tracer does not need is not linked, and what it counts is right.
#[test]
fn only_what_paths_need_is_linked() {
    let settings = settings(2, Bounces::Finite(1));
    let prepared = prepare(room(1.0, DVec3::ZERO, [8, 8]).scene(), &settings);
    let left_out = prepared.left_out();
    for feature in ["virtual point lights", "clamp", "antialiasing of edges", "Russian roulette"] {
        assert!(left_out.contains(&feature), "{feature} is linked: {left_out:?}");
    }
    for feature in ["path tracing", "area lights", "point lights"] {
        assert!(!left_out.contains(&feature), "{feature} is not linked");
    }
    let counts = frame(&prepared, &settings, 1).counts;
    assert_eq!((counts.vpls, counts.clamp, counts.visible_points), (0, None, 128));
    assert!(counts.shadow_rays > 128 && counts.shadow_rays <= 4 * 128, "{counts:?}");
}
