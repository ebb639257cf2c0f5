//! Colours of corners: what the camera sees of them, and the light that they reflect.

use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::render::{Method, Settings};
use gpu_vpl::scene::Scene;

use crate::common::{Build, mean, render_scene, room};

/// A square that the camera sees exactly, its corners coloured so that colours change evenly along it, and
/// a sphere behind the camera.
fn square() -> Build {
    let mut build = Build::new();
    let paint = build.material([1.0, 0.5, 0.25], [0.0; 3], false);
    let corner = |x: f64, y: f64| dvec3(x, y, 0.0);
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let color = |at: DVec3| {
        let [u, v] = [at.x, at.y].map(|x| 0.5 + 0.5 * x as f32);
        Vec3::new(u, v, 0.5 * (u + v))
    };
    for which in [[0, 1, 2], [0, 2, 3]] {
        let of = which.map(|i| corners[i]);
        build.triangle(paint, of);
        build.draft.color_last(of.map(color));
    }
    build.sphere(paint, dvec3(0.0, 0.0, 30.0), 1.0);
    build.point_light(dvec3(0.0, 0.0, 5.0), [1.0; 3]);
    build.camera(dvec3(0.0, 0.0, 1.0), DVec3::NEG_Z, 90.0, [16, 16]);
    build
}

#[test]
fn the_albedo_image_of_coloured_corners() {
    let settings = Settings { edge_samples: 1, ..Settings::of(Method::Albedo) };
    let image = square().render(&settings).image;
    for (index, pixel) in image.pixels.iter().enumerate() {
        let (x, y) = ((index % 16) as f32 + 0.5, (index / 16) as f32 + 0.5);
        let (u, v) = (x / 16.0, 1.0 - y / 16.0);
        let right = Vec3::new(u, 0.5 * v, 0.125 * (u + v));
        assert!(Vec3::from_array(*pixel).distance(right) < 1e-4, "{index}: {pixel:?}, not {right}");
    }
}

#[test]
fn a_sphere_beside_coloured_corners_keeps_its_colour() {
    let mut build = square();
    build.camera(dvec3(0.0, 0.0, 5.0), DVec3::Z, 1.0, [2, 2]);
    let settings = Settings { edge_samples: 1, ..Settings::of(Method::Albedo) };
    for pixel in build.render(&settings).image.pixels {
        assert_eq!(pixel, [1.0, 0.5, 0.25]);
    }
}

/// In every method, walls coloured at their corners are as walls of that colour: what they show, what
/// light paths leave there, and what is gathered.
#[test]
fn one_colour_at_all_corners_is_as_the_albedo() {
    let color = Vec3::new(0.5, 0.25, 0.75);
    let size = [16, 16];
    let plain = room(1.0, DVec3::ZERO, size).scene();
    let walls = |scene: &Scene, triangle: usize| scene.triangles[triangle].material == 0;
    let mut painted = plain.clone();
    painted.materials[0].albedo *= color;
    let mut colored = plain.clone();
    colored.colors = (0..plain.triangles.len())
        .map(|triangle| [if walls(&plain, triangle) { color } else { Vec3::ONE }; 3])
        .collect();
    for method in [Method::Direct, Method::Path, Method::Vpl, Method::Both] {
        let settings = Settings { light_paths: 300, samples: 4, ..Settings::of(method) };
        let [one, two, other] = [&painted, &colored, &plain]
            .map(|scene| mean(&render_scene(scene.clone(), &settings).image.pixels));
        for channel in 0..3 {
            let off = (one[channel] / two[channel] - 1.0).abs();
            assert!(off < 0.01, "{method:?}: {one:?}, {two:?}");
        }
        assert!(other[1] > 1.2 * one[1], "{method:?}: {other:?}, {one:?}");
    }
}
