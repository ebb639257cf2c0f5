//! Phong, mirror and glass: closed forms of single surfaces, and the methods against each other.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use crate::common::{self, Build, gpu, mean, render_scene};
use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::render::{Bounces, Clamp, Direct, Method, Prepared, Settings};
use gpu_vpl::scene::Bsdf;

fn phong(specular: f32, shininess: f32) -> Bsdf {
    Bsdf::Phong { specular: Vec3::splat(specular), shininess }
}

const CLEAR: Bsdf = Bsdf::Glass { specular: Vec3::ONE, ior: 1.5 };

/// A closed box of light without reflection, with a cube of some material in it.
fn box_of_light(bsdf: Bsdf, camera: DVec3, direction: DVec3) -> Build {
    let mut build = Build::new();
    let wall = build.material([0.0; 3], [1.0, 2.0, 3.0], false);
    let inside = build.finished([0.0; 3], bsdf);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    build.cuboid(inside, DVec3::splat(-0.3), DVec3::splat(0.3), false);
    build.camera(camera, direction, 60.0, [32, 32]);
    build
}

fn assert_even(pixels: &[[f32; 3]], expected: [f32; 3], tolerance: f32) {
    for (at, pixel) in pixels.iter().enumerate() {
        for (&got, expected) in pixel.iter().zip(expected) {
            assert!((got / expected - 1.0).abs() <= tolerance, "pixel {at}: {pixel:?}");
        }
    }
}

#[test]
fn mirrors_and_glass_show_all_of_an_even_light() {
    let mirror = Bsdf::Mirror { specular: Vec3::ONE };
    for bsdf in [mirror, CLEAR] {
        for method in [Method::Path, Method::Direct, Method::Vpl, Method::Both] {
            for samples in [1, 16, 32] {
                let settings = Settings { samples, light_paths: 100, ..Settings::of(method) };
                let build = box_of_light(bsdf, dvec3(-0.8, -0.7, 0.5), dvec3(0.8, 0.7, -0.5));
                let frame = build.render(&settings);
                // Paths that are caught in the cube are lost: of glass about 1e-4 of them.
                assert_even(&frame.image.pixels, [1.0, 2.0, 3.0], 1e-4);
            }
        }
    }
}

#[test]
fn radiance_in_glass_is_denser_by_the_square_of_its_index() {
    let build = box_of_light(CLEAR, DVec3::ZERO, dvec3(1.0, 0.02, 0.01));
    let settings = Settings { samples: 64, ..Settings::of(Method::Path) };
    let mut build = build;
    build.camera(DVec3::ZERO, dvec3(1.0, 0.02, 0.01), 20.0, [16, 16]);
    let frame = build.render(&settings);
    let dense = 1.5f32 * 1.5;
    // The camera stands in the glass: each path leaves at last with all that came in.
    assert_even(&frame.image.pixels, [dense, 2.0 * dense, 3.0 * dense], 1e-3);
}

/// A Phong plane lit from straight above, seen from straight above, is k_d E / π + k_s (n + 2) E /
/// 2π where the light is mirrored to the camera.
#[test]
fn a_phong_plane_shows_a_point_light() {
    let (albedo, specular, shininess) = (0.3, 0.4f32, 7.0f32);
    let mut build = Build::new();
    let plane = build.finished([albedo; 3], phong(specular, shininess));
    let corner = |x: f64, y: f64| dvec3(x, y, 0.0);
    build.polygon(
        plane,
        &[corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
    );
    build.point_light(dvec3(0.0, 0.0, 2.0), [8.0; 3]);
    build.camera(dvec3(0.0, 0.0, 3.0), dvec3(0.0, 0.0, -1.0), 30.0, [33, 33]);
    let scene = build.scene();
    for method in [Method::Direct, Method::Path, Method::Both] {
        let settings = Settings { samples: 1, edge_samples: 1, ..Settings::of(method) };
        let settings = Settings { bounces: Bounces::Finite(0), ..settings };
        let frame = render_scene(scene.clone(), &settings);
        for (at, pixel) in frame.image.pixels.iter().enumerate() {
            let [x, y] = [at % 33, at / 33]
                .map(|i| ((i as f64 + 0.5) / 33.0 * 2.0 - 1.0) * 3.0 * 15f64.to_radians().tan());
            let foot = dvec3(x, y, 0.0);
            let to_light = dvec3(0.0, 0.0, 2.0) - foot;
            let to_camera = (dvec3(0.0, 0.0, 3.0) - foot).normalize();
            let square = to_light.length_squared();
            let irradiance = 8.0 * 2.0 / square.powf(1.5);
            let mirrored = dvec3(-to_camera.x, -to_camera.y, to_camera.z);
            let lobe = mirrored.dot(to_light / square.sqrt()).powf(f64::from(shininess));
            let gloss = f64::from(specular) * (f64::from(shininess) + 2.0) / 2.0 * lobe;
            let expected = irradiance * (albedo + gloss) / std::f64::consts::PI;
            // Directions to the viewer have 16 bits a coordinate.
            assert!((f64::from(pixel[0]) / expected - 1.0).abs() < 2e-3, "{method:?}, pixel {at}");
        }
    }
}

/// A room with a glossy floor and a mirror, lit by a quad and a point light.
fn glossy_room(shininess: f32) -> Build {
    let mut build = Build::new();
    let wall = build.material([0.6, 0.5, 0.4], [0.0; 3], false);
    let floor = build.finished([0.3, 0.2, 0.2], phong(0.5, shininess));
    let lamp = build.material([0.0; 3], [12.0, 11.0, 10.0], false);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    let corner = |x, y, z| dvec3(x, y, z);
    let quad =
        |z: f64, s: f64| [corner(-s, -s, z), corner(s, -s, z), corner(s, s, z), corner(-s, s, z)];
    build.polygon(floor, &quad(-0.9, 0.99));
    let mut down = quad(0.9, 0.3);
    down.reverse();
    build.polygon(lamp, &down);
    build.camera(dvec3(-0.9, -0.8, 0.1), dvec3(0.7, 0.65, -0.4), 70.0, [16, 16]);
    build
}

#[test]
fn vpls_give_what_paths_find_in_glossy_rooms() {
    for (bounces, tolerance) in [(1, 0.01), (3, 0.015)] {
        let bounces = Bounces::Finite(bounces);
        let path = Settings { samples: 1024, bounces, ..Settings::of(Method::Path) };
        let expected = mean(&glossy_room(12.0).render(&path).image.pixels);
        for gpu in [gpu().clone(), gpu().clone().without_subgroups()] {
            let many = Settings {
                light_paths: 20_000,
                bounces,
                clamp: Clamp::Off,
                samples: 1,
                light_samples: Some(64),
                ..Settings::of(Method::Vpl)
            };
            let scene = glossy_room(12.0).scene();
            let got = mean(&common::render_on(gpu, scene, &many).image.pixels);
            for (got, expected) in got.iter().zip(expected) {
                assert!((got / expected - 1.0).abs() < tolerance, "{got} for {expected}");
            }
        }
    }
}

#[test]
fn clusters_of_one_shade_glossy_points_as_vpls_do() {
    let each = Settings { light_paths: 200, ..Settings::of(Method::Vpl) };
    let mut clustered =
        Settings { interleave: 1, candidates: 1, ..Settings { method: Method::Both, ..each } };
    clustered.clustering.points = 1 << 20;
    clustered.clustering.vpls = 1 << 20;
    clustered.clustering.fuzzy = 1;
    let [one, other] = [each, clustered].map(|s| glossy_room(12.0).render(&s).image.pixels);
    assert!(common::difference(&one, &other) < 1e-4);
}

#[test]
fn interleaved_subsets_share_lobes_too() {
    let few = Settings::of_vpls(Method::Both, 4000);
    let all = Settings { interleave: 1, candidates: 1, ..few };
    let [one, other] = [few, all].map(|s| mean(&glossy_room(12.0).render(&s).image.pixels));
    for (one, other) in one.iter().zip(other) {
        assert!((one / other - 1.0).abs() < 0.02, "{one} for {other}");
    }
}

/// Stripes of a floor, a few pixels wide, that reflect by a lobe alone, beside others that have none:
/// what a pixel's neighbours gather by no lobe is of no use to it.
#[test]
fn interleaved_subsets_are_shared_by_one_lobe() {
    let scene = || {
        let mut build = Build::new();
        let wall = build.material([0.6, 0.5, 0.4], [0.0; 3], false);
        let glossy = build.finished([0.0; 3], phong(0.8, 12.0));
        let black = build.material([0.0; 3], [0.0; 3], false);
        build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
        for (at, material) in (0..16).zip([glossy, black].into_iter().cycle()) {
            let [left, right] = [at, at + 1].map(|edge| -1.0 + f64::from(edge) / 8.0);
            let corner = |x, y| dvec3(x, y, -0.9);
            let stripe =
                [corner(left, -1.0), corner(right, -1.0), corner(right, 1.0), corner(left, 1.0)];
            build.polygon(material, &stripe);
        }
        build.point_light(dvec3(0.2, 0.3, 0.5), [1.0; 3]);
        build.camera(dvec3(0.0, -0.9, 0.9), dvec3(0.0, 0.6, -1.0), 40.0, [48, 48]);
        build
    };
    let few = Settings { direct: Direct::Off, ..Settings::of_vpls(Method::Both, 4000) };
    let all = Settings { interleave: 1, candidates: 1, ..few };
    let [one, other] = [few, all].map(|s| mean(&scene().render(&s).image.pixels)[1]);
    assert!((one / other - 1.0).abs() < 0.02, "{one} for {other}");
}

/// The light of a lamp that a mirror throws at a wall comes as VPLs on that wall.
#[test]
fn light_paths_go_on_at_mirrors() {
    let room = |with_mirror: bool| {
        let mut build = Build::new();
        let wall = build.material([0.5; 3], [0.0; 3], false);
        build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
        if with_mirror {
            let mirror = build.finished([0.0; 3], Bsdf::Mirror { specular: Vec3::ONE });
            let corner = |x: f64, y: f64| dvec3(x, y, -0.999);
            let quad = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            build.polygon(mirror, &quad);
        }
        build.point_light(dvec3(0.0, 0.0, -0.5), [1.0; 3]);
        build.camera(dvec3(0.0, -0.9, 0.0), dvec3(0.0, 0.7, 0.4), 60.0, [16, 16]);
        build.scene()
    };
    let settings =
        Settings { direct: Direct::Off, bounces: Bounces::Finite(1), ..Settings::of(Method::Vpl) };
    for with_mirror in [false, true] {
        let prepared = Prepared::new(gpu().clone(), room(with_mirror), &settings).unwrap();
        let vpls = gpu_vpl::render::light_paths(&prepared, &settings, 1);
        let flux: f32 = vpls.iter().map(|vpl| vpl.flux.x).sum();
        // All light arrives: nothing deposits on the mirror, and it takes nothing.
        let scale = prepared.scene.units.scale.powi(2) as f32;
        let expected = 4.0 * std::f32::consts::PI;
        assert!((flux * scale / expected - 1.0).abs() < 1e-3, "{flux}");
        let on_floor = vpls.iter().filter(|vpl| vpl.normal.z > 0.9).count();
        assert_eq!(on_floor == 0, with_mirror);
    }
}

/// A diffuse block beside a mirror in a box of even light: what the mirror hides it shows, too, so
/// that the block is ρ L everywhere. (Glass above it would also show the block itself.)
#[test]
fn paths_find_all_light_that_mirrors_turn() {
    let mut build = Build::new();
    let wall = build.material([0.0; 3], [1.0, 2.0, 3.0], false);
    let mirror = build.finished([0.0; 3], Bsdf::Mirror { specular: Vec3::ONE });
    let block = build.finished([0.6; 3], Bsdf::Diffuse);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    build.cuboid(block, dvec3(-0.2, -0.9, -0.9), dvec3(0.2, 0.9, 0.0), false);
    build.cuboid(mirror, dvec3(-0.6, -0.9, -0.9), dvec3(-0.4, 0.9, 0.6), false);
    // The top of the block fills the image.
    build.camera(dvec3(0.0, 0.0, 0.3), DVec3::NEG_Z, 30.0, [8, 8]);
    let settings =
        Settings { samples: 4096, bounces: Bounces::Finite(0), ..Settings::of(Method::Path) };
    let pixels = build.render(&settings).image.pixels;
    assert_even(&pixels, [0.6, 1.2, 1.8], 0.02);
    let off = mean(&pixels)[0] / 0.6 - 1.0;
    assert!(off.abs() < 2e-3, "mean off by {off}");
}
