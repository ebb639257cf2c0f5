//! Emitting spheres: as direct light, seen by paths, and as the source of VPLs.

use std::f64::consts::PI;

use crate::common::lights::{ALBEDO, direct_light, first_flux, one_bounce_agrees, plane, seen};
use crate::common::{Build, mean, render_scene};
use glam::{DVec3, dvec3};
use gpu_vpl::render::{Bounces, Clamp, Method, Settings};

/// A sphere above the horizon gives E = π L (r / d)² cos θ, however near or far it is.
#[test]
fn a_sphere_over_a_plane() {
    let (height, fov, size) = (3.0, 50.0, 16);
    let seen = seen(height, fov, size);
    for (scale, light, radius) in [
        (1.0, dvec3(1.8, -0.4, 0.8), 0.5),
        (1e-6, dvec3(-1.5, 0.9, 1.5), 0.1),
        (1e6, dvec3(6.0, 3.0, 7.0), 1e-3),
    ] {
        let mut build = plane(scale, height, fov, size);
        let lamp = build.material([0.0; 3], [3.0; 3], false);
        build.sphere(lamp, light, radius);
        for (way, frame) in direct_light(&build.scene(), 256) {
            let mut sum = [0.0; 2];
            let mut worst = 0.0;
            for (i, pixel) in frame.image.pixels.iter().enumerate() {
                let way = light - seen(i);
                let square = way.length_squared();
                let cosine = light.z / square.sqrt();
                let expected = ALBEDO[0] * 3.0 * radius * radius / square * cosine;
                sum = [sum[0] + f64::from(pixel[0]), sum[1] + expected];
                worst = f64::max(worst, (f64::from(pixel[0]) / expected - 1.0).abs());
            }
            // Paths are jittered in the pixel.
            let most = if way == "path" { 0.1 } else { 0.02 };
            let off = (sum[0] / sum[1] - 1.0).abs();
            assert!(worst < most && off < 0.1 * most, "{way}, {radius}: {worst}, mean {off}");
        }
    }
}

/// A closed sphere that emits inwards and reflects: L = L_e (1 - ρ^(B + 2)) / (1 - ρ), per pixel.
#[test]
fn a_furnace_in_a_sphere() {
    for (albedo, bounces) in [(0.3, 0), (0.5, 1), (0.8, 3)] {
        for method in [Method::Path, Method::Vpl] {
            let mut build = Build::new();
            let wall = build.material([albedo; 3], [1.0, 2.0, 0.5], true);
            build.sphere(wall, DVec3::ZERO, 1.0);
            build.camera(dvec3(0.3, -0.2, 0.1), dvec3(1.0, 0.4, 0.2), 90.0, [16, 16]);
            let settings = Settings {
                bounces: Bounces::Finite(bounces),
                clamp: Clamp::Off,
                samples: if method == Method::Path { 256 } else { 1 },
                light_samples: (method == Method::Vpl).then_some(256),
                light_paths: 4000,
                ..Settings::of(method)
            };
            let frame = build.render(&settings);
            let terms = 1.0 - albedo.powi(bounces as i32 + 2);
            for (i, pixel) in frame.image.pixels.iter().enumerate() {
                for (&got, emission) in pixel.iter().zip([1.0, 2.0, 0.5]) {
                    let expected = emission * terms / (1.0 - albedo);
                    let off = (f64::from(got) / expected - 1.0).abs();
                    // VPLs here are uniform, with G the same for every pair; samples are not.
                    assert!(off < 0.03, "{method:?}, {bounces}: pixel {i} {got}, not {expected}");
                }
            }
            let off = mean(&frame.image.pixels)[0] * (1.0 - albedo) / terms - 1.0;
            assert!(off.abs() < 3e-3, "{method:?}, {bounces}: mean off by {off}");
        }
    }
}

#[test]
fn the_flux_of_a_sphere() {
    let mut build = Build::new();
    let wall = build.material([0.5; 3], [0.0; 3], false);
    let lamp = build.material([0.0; 3], [1.0, 2.0, 3.0], false);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    build.sphere(lamp, dvec3(0.2, 0.1, -0.3), 0.25);
    build.camera(DVec3::ZERO, DVec3::X, 60.0, [4, 4]);
    let [flux, _] = first_flux(&build.scene(), 1 << 14);
    let expected = dvec3(1.0, 2.0, 3.0) * PI * 4.0 * PI * 0.25 * 0.25;
    assert!((flux / expected - DVec3::ONE).abs().max_element() < 1e-3, "{flux}, not {expected}");
}

#[test]
fn one_bounce_of_a_sphere() {
    let mut build = Build::open_room();
    let lamp = build.material([0.0; 3], [30.0, 27.0, 21.0], false);
    build.sphere(lamp, dvec3(0.3, -0.6, 1.6), 0.15);
    one_bounce_agrees(&build.scene(), 1 << 14, "sphere");
}

/// Spheres and triangles of the same material, each with its own density: the path tracer weighs
/// both ways to a light alike, so that the sum does not depend on how often it takes each.
#[test]
fn spheres_and_triangles_of_one_material() {
    let lit = |which: [bool; 2]| {
        let mut build = Build::new();
        let wall = build.material([0.6; 3], [0.0; 3], false);
        let lamp = build.material([0.3; 3], [5.0; 3], false);
        build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
        let black = build.material([0.3; 3], [0.0; 3], false);
        build.sphere(if which[0] { lamp } else { black }, dvec3(0.5, 0.5, 0.3), 0.2);
        let corner = |x: f64, y: f64| dvec3(x, y, 0.9);
        let quad = [corner(-0.6, -0.2), corner(-0.6, 0.2), corner(-0.2, 0.2), corner(-0.2, -0.2)];
        build.polygon(if which[1] { lamp } else { black }, &quad);
        build.camera(dvec3(-0.9, -0.8, 0.1), dvec3(0.7, 0.65, -0.3), 80.0, [16, 16]);
        let bounces = Bounces::Finite(2);
        let settings = Settings { samples: 1024, bounces, ..Settings::of(Method::Path) };
        mean(&render_scene(build.scene(), &settings).image.pixels)[0]
    };
    let [both, one, other] = [[true, true], [true, false], [false, true]].map(lit);
    assert!((both / (one + other) - 1.0).abs() < 0.01, "{both}, not {one} + {other}");
}

/// A small lamp that is seen covers its share of the pixels, whichever way it is antialiased.
#[test]
fn a_small_lamp_is_as_bright_as_it_is_large() {
    let shown = |method: Method| {
        let mut build = Build::open_room();
        let lamp = build.material([0.0; 3], [30.0; 3], false);
        build.sphere(lamp, dvec3(-0.5, -0.2, 0.6), 0.15);
        let few = Settings { edge_samples: 256, ..Settings::of(method) };
        let settings = match method {
            Method::Path => Settings { samples: 4096, bounces: Bounces::Finite(0), ..few },
            _ => few,
        };
        mean(&build.render(&settings).image.pixels)[0]
    };
    let [direct, path] = [Method::Direct, Method::Path].map(shown);
    assert!((direct / path - 1.0).abs() < 0.02, "{direct}, paths {path}");
}
