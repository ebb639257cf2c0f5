//! Bias compensation: with what it gives back, the bound on the geometry term changes nothing but
//! the noise. A bound near 0 leaves all indirect light to the compensating paths, so that each
//! bounce, lobe and light that they miss or count twice shows in the mean.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use crate::common::paths::{self, mean_and_error};
use crate::common::{Build, difference, frame, furnace, gpu, mean, room};
use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::gpu::Gpu;
use gpu_vpl::metrics::largest;
use gpu_vpl::render::{Bounces, Clamp, Direct, Frame, Method, Prepared, Settings};
use gpu_vpl::scene::{Bsdf, Environment, Scene};

/// All bounds of interest, in rooms about 2 units wide: one that leaves everything to paths, one
/// that leaves them half, and the one that is chosen.
const BOUNDS: [Clamp; 3] = [Clamp::At(1e-6), Clamp::At(0.5), Clamp::Auto];

fn compensated(method: Method, clamp: Clamp, bounces: Bounces) -> Settings {
    let light_paths = light_paths(4000, clamp);
    Settings { compensate: true, clamp, bounces, ..Settings::of_vpls(method, light_paths) }
}

/// So many light paths, or few where the bound leaves nothing to their VPLs.
fn light_paths(count: u32, clamp: Clamp) -> u32 {
    if matches!(clamp, Clamp::At(bound) if bound <= 1e-6) { count / 20 } else { count }
}

fn render(gpu: Gpu, scene: &Scene, settings: &Settings) -> Frame {
    frame(&Prepared::new(gpu, scene.clone(), settings).unwrap(), settings)
}

/// The largest deviation of the mean of a channel, relative.
fn off(got: [f64; 3], expected: [f64; 3]) -> f64 {
    largest((0..3).map(|channel| (got[channel] / expected[channel] - 1.0).abs()))
}

#[test]
fn a_furnace_has_its_radiance_whatever_the_bound() {
    let (albedo, emission) = ([0.5, 0.25, 0.8], [1.0, 2.0, 0.5]);
    let scene = furnace(albedo, emission, 100.0).scene();
    let cases = [Some(1), Some(2), Some(5), None];
    for (bounces, clamp) in cases.iter().flat_map(|b| BOUNDS.map(|clamp| (*b, clamp))) {
        let clamp = match clamp {
            // Of a room a hundred times as large.
            Clamp::At(bound) => Clamp::At(bound / 1e4),
            other => other,
        };
        let most = bounces.map_or(Bounces::Unlimited, Bounces::Finite);
        for method in [Method::Vpl, Method::Both] {
            let settings = compensated(method, clamp, most);
            let frame = render(gpu().clone(), &scene, &settings);
            let expected = [0, 1, 2].map(|channel| {
                let terms = bounces.map_or(0.0, |b| f64::powi(albedo[channel], b as i32 + 2));
                emission[channel] * (1.0 - terms) / (1.0 - albedo[channel])
            });
            // 32 × 32 pixels of 8 paths (`both`) or 32, each of a deviation below its mean, are good
            // to 1.1 % in one standard deviation; in a furnace paths hardly deviate.
            let got = mean(&frame.image.pixels);
            assert!(
                off(got, expected) < 0.01,
                "{method:?}, {most:?}, {clamp:?}: {got:?}, not {expected:?}"
            );
        }
    }
}

/// Corners, a lamp near the ceiling and a point light: pixels in tiles, against the path tracer.
#[test]
fn corners_are_those_of_the_path_tracer() {
    let scene = room(1.0, DVec3::ZERO, [32, 32]).scene();
    for bounces in [Bounces::Finite(1), Bounces::Finite(3), Bounces::Unlimited] {
        let path = Settings { samples: 256, bounces, ..Settings::of(Method::Path) };
        let path = Settings { direct: Direct::Off, ..path };
        let expected = render(gpu().clone(), &scene, &path);
        let tiles_of = |frame: &Frame| tiles(&frame.image.pixels, 32, 8);
        let reference = tiles_of(&expected);
        for clamp in BOUNDS {
            let methods = [Method::Vpl, Method::Vplc, Method::Vpc, Method::Both];
            // Each of them once with each bound.
            for method in
                methods.into_iter().filter(|m| bounces != Bounces::Unlimited || *m == Method::Both)
            {
                let settings = Settings {
                    direct: Direct::Off,
                    light_paths: light_paths(2000, clamp),
                    samples: 8,
                    edge_samples: 16,
                    ..compensated(method, clamp, bounces)
                };
                let frame = render(gpu().clone(), &scene, &settings);
                let what = format!("{method:?}, {clamp:?}, {bounces:?}");
                let (mean_got, mean_expected) =
                    (mean(&frame.image.pixels), mean(&expected.image.pixels));
                assert!(off(mean_got, mean_expected) < 0.015, "{what}: {mean_got:?}");
                // 512 compensating paths a tile and 16,000 light paths: the worst of 16 tiles. With
                // the bound on and nothing given back a corner lacks more than half.
                let tiles = tiles_of(&frame);
                let worst = largest(tiles.iter().zip(&reference).map(|(a, b)| off(*a, *b)));
                assert!(worst < 0.15, "{what}: a tile is off by {worst}");
            }
        }
    }
}

/// Means of square tiles.
fn tiles(pixels: &[[f32; 3]], width: usize, size: usize) -> Vec<[f64; 3]> {
    let across = width / size;
    let tile = |t: usize| {
        let inside = (0..size * size).map(move |i| {
            let [x, y] = [t % across * size + i % size, t / across * size + i / size];
            y * width + x
        });
        mean(&inside.map(|at| pixels[at]).collect::<Vec<_>>())
    };
    (0..across * across).map(tile).collect()
}

/// Walls and a block with lobes, lit by a lamp and a point light.
#[test]
fn glossy_corners_are_those_of_the_path_tracer() {
    let mut build = room(1.0, DVec3::ZERO, [24, 24]);
    let lobes = [(0.25, 3.0), (0.5, 40.0)];
    for (material, (specular, shininess)) in build.draft.materials.iter_mut().zip(lobes) {
        material.albedo *= 0.5;
        material.bsdf = Bsdf::Phong { specular: Vec3::splat(specular), shininess };
    }
    let scene = build.scene();
    let bounces = Bounces::Finite(2);
    let direct = Direct::Off;
    let path = Settings { samples: 1024, bounces, direct, ..Settings::of(Method::Path) };
    let path = render(gpu().clone(), &scene, &path);
    for clamp in [Clamp::At(1e-6), Clamp::At(0.5), Clamp::Auto] {
        let settings = Settings { direct, samples: 16, ..compensated(Method::Vpl, clamp, bounces) };
        let got = render(gpu().clone(), &scene, &settings);
        for channel in 0..3 {
            let (expected, error) = mean_and_error(&path, channel);
            let (value, _) = mean_and_error(&got, channel);
            let off = (value / expected - 1.0).abs();
            // 9216 compensating paths for each lobe, and 4000 light paths.
            let most = 4.0 * error / expected + 0.01;
            assert!(off < most, "{clamp:?}: {value}, not {expected} ± {error}");
        }
    }
}

/// A room of which some surfaces are of another BSDF, open to a sky, with lights of all kinds.
fn bsdfs(bsdfs: &[Bsdf]) -> Scene {
    let mut build = Build::open_room();
    for (at, bsdf) in (0..).zip(bsdfs) {
        let albedo = if bsdf.is_specular() { [0.0; 3] } else { [0.3, 0.4, 0.2] };
        let own = build.finished(albedo, *bsdf);
        let low = dvec3(-0.8 + 0.6 * f64::from(at), -0.7, -0.95);
        build.cuboid(own, low, low + dvec3(0.4, 0.4, 0.9), false);
    }
    let lamp = build.material([0.5; 3], [9.0, 8.0, 7.0], true);
    let corner = |x, y| dvec3(x, y, 0.6);
    build.polygon(
        lamp,
        &[corner(-0.2, -0.2), corner(-0.2, 0.2), corner(0.2, 0.2), corner(0.2, -0.2)],
    );
    let shining = build.material([0.2; 3], [3.0, 2.0, 6.0], false);
    build.sphere(shining, dvec3(0.75, -0.2, -0.75), 0.12);
    // Paths from the camera do not find lights without extent in mirrors or through glass.
    if !bsdfs.iter().any(|bsdf| bsdf.is_specular()) {
        let down = dvec3(0.1, 0.2, -1.0);
        build.point_light(dvec3(0.1, -0.9, 0.7), [0.4, 0.5, 0.6]);
        build.spot_light(dvec3(-0.5, 0.0, 0.8), down, [3.0, 2.0, 1.0], [20.0, 35.0]);
        build.directional_light(dvec3(0.3, 0.5, -1.0), [0.5, 0.4, 0.9]);
    }
    build.draft.environment = Some(Environment { radiance: Vec3::new(0.2, 0.3, 0.5), image: None });
    let camera = build.draft.camera.as_mut().unwrap();
    camera.size = [16, 16];
    build.scene()
}

/// With everything left to paths, the mean is that of VPLs without a bound: the same light, also
/// where mirrors and glass take a part of it away.
#[test]
fn every_finish_and_light_is_given_back() {
    let phong = |specular, shininess| Bsdf::Phong { specular: Vec3::splat(specular), shininess };
    let mirror = Bsdf::Mirror { specular: Vec3::splat(0.9) };
    let glass = Bsdf::Glass { specular: Vec3::ONE, ior: 1.5 };
    let cases = [
        ("lights", vec![]),
        ("phong", vec![phong(0.5, 1.0), phong(0.6, 8.0), phong(0.5, 30.0)]),
        ("mirror", vec![mirror]),
        ("glass", vec![glass]),
        ("all", vec![mirror, phong(0.5, 10.0), glass]),
    ];
    for (name, bsdf) in cases {
        let scene = bsdfs(&bsdf);
        let bounces = Bounces::Finite(2);
        let common = Settings {
            direct: Direct::Off,
            samples: 4,
            edge_samples: 4,
            light_paths: 3000,
            ..compensated(Method::Vpl, Clamp::Off, bounces)
        };
        let (expected, error) = indirect(&scene, &common);
        for clamp in [Clamp::At(1e-6), Clamp::At(0.5)] {
            let light_paths = light_paths(common.light_paths, clamp);
            let (got, own_error) = indirect(&scene, &Settings { clamp, light_paths, ..common });
            for channel in 0..3 {
                // Eight seeds do not know their error well: five of it, and what f32 rounds.
                let off = (got[channel] - expected[channel]).abs();
                let noise = error[channel].hypot(own_error[channel]);
                let most = 5.0 * noise + 1e-4 * expected[channel];
                assert!(off < most, "{name}, {clamp:?}: {got:?}, not {expected:?} ± {noise}");
                assert!(noise < 0.02 * expected[channel], "{name}, {clamp:?}: ± {noise}");
            }
        }
    }
}

/// The mean of the indirect light over an image and eight seeds, per channel, and its standard
/// error.
fn indirect(scene: &Scene, settings: &Settings) -> ([f64; 3], [f64; 3]) {
    const SEEDS: u32 = 8;
    let prepared = Prepared::new(gpu().clone(), scene.clone(), settings).unwrap();
    let of_seed = |settings: &Settings, seed: u32| {
        mean(&paths::frame(&prepared, settings, seed).image.pixels)
    };
    // What is emitted varies with the places of the samples.
    let emitted = Settings { bounces: Bounces::Finite(0), ..*settings };
    let indirect = |seed: u32| {
        let [all, rest] = [settings, &emitted].map(|settings| of_seed(settings, seed));
        [0, 1, 2].map(|c| all[c] - rest[c])
    };
    let all: Vec<_> = (0..SEEDS).map(indirect).collect();
    let count = f64::from(SEEDS);
    let means = [0, 1, 2].map(|c| all.iter().map(|of| of[c]).sum::<f64>() / count);
    let errors = [0, 1, 2].map(|c| {
        let squares: f64 = all.iter().map(|of| (of[c] - means[c]).powi(2)).sum();
        (squares / (count * (count - 1.0))).sqrt()
    });
    (means, errors)
}

/// A lamp that lights a wall by a mirror alone: paths from the camera find nothing of it, so that
/// what the bound takes of it is lost.
#[test]
fn no_image_is_darker_for_it() {
    let mut build = Build::open_room();
    let mirror = build.finished([0.0; 3], Bsdf::Mirror { specular: Vec3::splat(0.9) });
    build.cuboid(mirror, dvec3(0.45, 0.1, -0.95), dvec3(0.98, 0.8, -0.9), false);
    build.spot_light(dvec3(0.0, -0.6, 0.4), dvec3(0.765, 1.07, -1.3), [3.0; 3], [4.0, 6.0]);
    build.draft.camera.as_mut().unwrap().size = [24, 24];
    let scene = build.scene();
    let energy = |compensate| {
        let settings = compensated(Method::Vpl, Clamp::Auto, Bounces::Finite(1));
        let settings = Settings { direct: Direct::Off, compensate, samples: 4, ..settings };
        mean(&render(gpu().clone(), &scene, &settings).image.pixels)[1]
    };
    let (without, with) = (energy(false), energy(true));
    assert!(without > 0.0 && with > 0.999 * without, "{with} instead of {without}");
}

/// The report's share is of what the bound took, whether or not some is given back, and whatever
/// noise that has.
#[test]
fn the_share_that_is_given_back_is_that_which_was_taken() {
    let mut build = Build::open_room();
    let colors = [[0.9, 0.05, 0.1], [0.1, 0.9, 0.05], [0.05, 0.1, 0.9]];
    for (at, color) in (0..).zip(colors) {
        let own = build.material(color, [0.0; 3], false);
        let low = dvec3(-0.9 + 0.6 * f64::from(at), -0.7, -0.95);
        build.cuboid(own, low, low + dvec3(0.5, 0.5, 0.9), false);
    }
    build.point_light(dvec3(0.1, -0.9, 0.7), [0.4, 0.5, 0.6]);
    build.draft.camera.as_mut().unwrap().size = [64, 64];
    let scene = build.scene();
    let share = |compensate| {
        let settings = compensated(Method::Both, Clamp::At(0.05), Bounces::Finite(2));
        let settings = Settings { compensate, ..settings };
        render(gpu().clone(), &scene, &settings).counts.clamped_fraction
    };
    let (without, with) = (share(false), share(true));
    // Combining pixels moves some light over the edges of tiles and things.
    assert!(without > 0.1 && (with / without - 1.0).abs() < 0.01, "{with} instead of {without}");
}

#[test]
fn where_nothing_is_bounded_nothing_is_given_back() {
    let scene = room(1.0, DVec3::ZERO, [24, 24]).scene();
    let both = [false, true];
    let off = both.map(|compensate| Settings {
        clamp: Clamp::Off,
        compensate,
        ..Settings::of(Method::Both)
    });
    let none = both.map(|compensate| Settings {
        bounces: Bounces::Finite(0),
        compensate,
        ..Settings::of(Method::Both)
    });
    let path = both.map(|compensate| Settings { compensate, ..Settings::of(Method::Path) });
    for [without, with] in [off, none, path] {
        let [a, b] = [without, with].map(|settings| {
            let prepared = Prepared::new(gpu().clone(), scene.clone(), &settings).unwrap();
            let image = frame(&prepared, &settings).image;
            let left_out = prepared.left_out();
            assert!(left_out.contains(&"bias compensation"), "{left_out:?}");
            image
        });
        assert_eq!(a.pixels, b.pixels);
    }
}

#[test]
fn given_back_light_is_the_same_on_all_kernels_and_twice() {
    let scene = room(1.0, DVec3::ZERO, [24, 40]).scene();
    let settings = compensated(Method::Both, Clamp::Auto, Bounces::Finite(2));
    let [one, two] = [(), ()].map(|()| render(gpu().clone(), &scene, &settings).image.pixels);
    assert_eq!(one, two);
    let plain = render(gpu().clone().without_subgroups(), &scene, &settings).image.pixels;
    // Sums in another order; and rays that pass an edge by rounding alone.
    let near = one.iter().zip(&plain).filter(|(a, b)| difference(&[**a], &[**b]) < 1e-3).count();
    assert!(near * 100 >= one.len() * 99, "{near} of {} pixels agree", one.len());
}

/// The noise of what is given back falls with the samples, to the mean of the path tracer.
#[test]
fn compensated_images_converge() {
    let scene = room(1.0, DVec3::ZERO, [16, 16]).scene();
    let bounces = Bounces::Finite(2);
    let path =
        Settings { samples: 1024, bounces, direct: Direct::Off, ..Settings::of(Method::Path) };
    let path = render(gpu().clone(), &scene, &path);
    let settings = Settings {
        direct: Direct::Off,
        samples: 64,
        light_paths: 8000,
        ..compensated(Method::Vpl, Clamp::Auto, bounces)
    };
    let got = render(gpu().clone(), &scene, &settings);
    for channel in 0..3 {
        let (expected, error) = mean_and_error(&path, channel);
        let (value, _) = mean_and_error(&got, channel);
        let off = (value - expected).abs();
        assert!(off < 4.0 * error + 0.005 * expected, "{value} not {expected} ± {error}");
    }
}
