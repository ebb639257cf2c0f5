//! Frames of and inside spheres against closed forms.

#![allow(clippy::expect_used, clippy::panic, reason = "a helper of tests fails by panicking")]

use std::f64::consts::PI;

use crate::common::paths::mean_and_error;
use crate::common::{self, Build};
use glam::{DVec3, dvec3};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Bounces, Clamp, Method, Settings};

/// The inside of a sphere with a point light in its middle.
fn lit_sphere(radius: f64, albedo: [f64; 3], scale: f64) -> Build {
    let mut build = Build::at(scale, DVec3::ZERO);
    let wall = build.material(albedo, [0.0; 3], false);
    let center = dvec3(0.3, -0.2, 0.1);
    build.sphere(wall, center, radius);
    build.point_light(center, [1.0, 2.0, 3.0]);
    build.camera(center + dvec3(0.2, 0.3, -0.5) * radius, dvec3(1.0, 0.4, 0.2), 90.0, [24, 24]);
    build
}

/// The farthest of any channel from what is expected, relatively.
fn farthest(image: &Image, expected: [f64; 3]) -> f64 {
    let off = |pixel: &[f32; 3]| {
        let channels = pixel.iter().zip(expected);
        channels.map(|(&got, right)| (f64::from(got) / right - 1.0).abs()).fold(0.0, f64::max)
    };
    image.pixels.iter().map(off).fold(0.0, f64::max)
}

/// Every point and every VPL inside a sphere see each other, with G = 1/(4R²): direct light and B
/// bounces are B + 1 terms of a geometric series, in every pixel.
#[test]
fn a_point_light_in_a_sphere() {
    let albedo = [0.8, 0.5, 1.0];
    for (radius, bounces, scale) in [(1.0, 0, 1.0), (0.7, 3, 1e-6), (2.0, 6, 1e6)] {
        let terms = |rho: f64| (0..=bounces).map(|k| rho.powi(k as i32)).sum::<f64>();
        let expected = std::array::from_fn(|channel| {
            let rho: f64 = albedo[channel];
            rho / PI * (channel + 1) as f64 / (radius * radius) * terms(rho)
        });
        for method in [Method::Path, Method::Vpl] {
            let settings = Settings {
                bounces: Bounces::Finite(bounces),
                light_paths: 500,
                clamp: Clamp::Off,
                samples: 2,
                ..Settings::of(method)
            };
            let frame = lit_sphere(radius, albedo, scale).render(&settings);
            let off = farthest(&frame.image, expected);
            // A VPL next to a point has cosines of few bits.
            let most = if method == Method::Path { 2e-5 } else { 1e-3 };
            assert!(off < most, "{method:?}, R = {radius}, B = {bounces}: off by {off}");
        }
    }
}

/// E = Φ / (4 π R² (1 - ρ)) with all bounces.
#[test]
fn a_point_light_in_a_sphere_with_all_bounces() {
    let albedo = [0.8, 0.5, 0.2];
    let settings = Settings {
        bounces: Bounces::Unlimited,
        samples: 64,
        light_paths: 4000,
        clamp: Clamp::Off,
        ..Settings::of(Method::Path)
    };
    for method in [Method::Path, Method::Vpl] {
        let samples = if method == Method::Path { 64 } else { 1 };
        let settings = Settings { method, samples, ..settings };
        let frame = lit_sphere(1.5, albedo, 1.0).render(&settings);
        for (channel, rho) in albedo.into_iter().enumerate() {
            let (mean, error) = mean_and_error(&frame, channel);
            let expected = rho / PI * (channel + 1) as f64 / 1.5f64.powi(2) / (1.0 - rho);
            let off = (mean / expected - 1.0).abs();
            // Roulette of 4000 light paths deviates by a few per cent.
            let most = if method == Method::Path { 4.0 * error / expected + 1e-4 } else { 0.04 };
            assert!(off < most, "{method:?}: {mean}, not {expected}, ± {error}");
        }
    }
}

/// A sphere lit and seen from outside: no pixel up to the terminator is dark, whatever the size of
/// the sphere in its scene.
#[test]
fn a_sphere_lit_from_outside_has_no_acne() {
    for (radius, distance) in [(1.0, 4.0), (1e-3, 5e-3), (1e-4, 1e-3)] {
        let mut build = Build::new();
        let white = build.material([1.0; 3], [0.0; 3], false);
        let center = dvec3(0.7, 0.1, -0.4);
        build.sphere(white, center, radius);
        // Makes the scene as large as it is beside small spheres.
        build.sphere(white, dvec3(-8.0, 0.0, 0.0), 0.01);
        let light = center + distance * dvec3(0.6, 0.64, 0.48);
        let eye = center + distance * DVec3::Z;
        let size = 64;
        let fov = 2.0 * (1.1 * radius / distance).asin();
        build.point_light(light, [radius * radius; 3]);
        build.camera(eye, DVec3::NEG_Z, fov.to_degrees(), [size, size]);
        let settings = Settings { edge_samples: 1, ..Settings::of(Method::Direct) };
        let scene = build.scene();
        let (right, up, scale) = (scene.camera.right, scene.camera.up, scene.units.scale);
        let image = common::render_scene(scene, &settings).image;
        let (mut lit, mut dark) = (0, 0);
        for (i, pixel) in (0..).zip(&image.pixels) {
            let at =
                |i: u32| ((2.0 * f64::from(i) + 1.0) / f64::from(size) - 1.0) * (fov / 2.0).tan();
            let [x, y] = [at(i % size), at(i / size)];
            let direction = x * right.as_dvec3() - y * up.as_dvec3() + DVec3::NEG_Z;
            let along = (center - eye).dot(direction) / direction.length_squared();
            let nearest = (eye + along * direction - center).length();
            let half = (radius * radius - nearest * nearest).sqrt() / direction.length();
            // The rim is where rounding decides.
            if half.is_nan() || nearest > 0.99 * radius {
                continue;
            }
            let place = eye + (along - half) * direction;
            let to_light = light - place;
            let cosine = (place - center).dot(to_light) / radius / to_light.length();
            let expected = radius * radius / PI * cosine.max(0.0) / to_light.length_squared();
            let got = f64::from(pixel[0]);
            // Positions are f32 of the whole scene, so a normal is off by this angle.
            let most = (4e-7 * scale / radius).max(1e-5) * radius * radius
                / PI
                / to_light.length_squared();
            assert!((got - expected).abs() <= most, "R = {radius}, {i}: {got}, not {expected}");
            *(if expected > 0.0 { &mut lit } else { &mut dark }) += 1;
        }
        assert!(lit > 500 && dark > 100, "{lit} lit, {dark} dark");
    }
}

/// A sphere of many triangles.
fn tessellated(build: &mut Build, material: u32, center: DVec3, radius: f64) {
    const ROWS: u32 = 96;
    let at = |i: u32, j: u32| {
        let (polar, turn) =
            (PI * f64::from(i) / f64::from(ROWS), PI * f64::from(j) / f64::from(ROWS));
        let across = polar.sin();
        center + radius * dvec3(across * turn.cos(), across * turn.sin(), polar.cos())
    };
    for i in 0..ROWS {
        for j in 0..2 * ROWS {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            build.triangle(material, [quad[0], quad[1], quad[2]]);
            build.triangle(material, [quad[0], quad[2], quad[3]]);
        }
    }
}

/// A sphere in a room is what a finely tessellated one is, in every method.
#[test]
fn a_sphere_is_a_fine_polyhedron() {
    let render = |round: bool, settings: &Settings| {
        let mut build = common::room(1.0, DVec3::ZERO, [48, 32]);
        let blue = build.material([0.3, 0.4, 0.9], [0.0; 3], false);
        let (center, radius) = (dvec3(0.1, -0.4, -0.5), 0.4);
        match round {
            true => build.sphere(blue, center, radius),
            false => tessellated(&mut build, blue, center, radius),
        }
        build.render(settings)
    };
    for method in [Method::Normal, Method::Depth, Method::Direct, Method::Vpl, Method::Both] {
        let settings = Settings { light_paths: 300, edge_samples: 1, ..Settings::of(method) };
        let [one, two] = [true, false].map(|round| render(round, &settings).image);
        let pairs = || one.pixels.as_flattened().iter().zip(two.pixels.as_flattened());
        let mean = pairs().map(|(_, b)| f64::from(b.abs())).sum::<f64>();
        let off = pairs().map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / mean;
        // A flat shade for a round one is 1/96 of half a turn off; pixels at the rim differ.
        let most = if method == Method::Both { 0.03 } else { 0.02 };
        assert!(off < most, "{method:?}: {off}");
        assert!(off > 1e-6, "{method:?}: the two are the same scene");
    }
}

#[test]
fn a_wrong_image_is_seen() {
    let image = Image { width: 1, height: 1, pixels: vec![[1.0, 2.0, 3.0]] };
    assert!(farthest(&image, [1.0, 2.0, 3.003]) > 9e-4);
}
