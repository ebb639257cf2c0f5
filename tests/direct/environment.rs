//! Light from all directions: as direct light, to paths, as the source of VPLs, and as what is
//! seen behind everything.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::f64::consts::PI;

use crate::common::lights::{ALBEDO, direct_light, first_flux, one_bounce_agrees, plane};
use crate::common::paths::mean_and_error;
use crate::common::{self, Build, Rng, frame, gpu, render_scene};
use glam::{DVec3, Vec2, Vec3, dvec3};
use gpu_vpl::image::Image;
use gpu_vpl::render::{Bounces, Clamp, Direct, Method, Prepared, Settings};
use gpu_vpl::scene::environment::{direction, pack};
use gpu_vpl::scene::{Environment, EnvironmentImage};

const RADIANCE: [f32; 3] = [2.0, 1.0, 0.5];

fn constant() -> Environment {
    Environment { radiance: Vec3::from_array(RADIANCE), image: None }
}

fn of_image(size: [u32; 2], texel: impl Fn(u32, u32) -> Vec3) -> Environment {
    let all = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    let texels = all.map(|(x, y)| pack(texel(x, y))).collect();
    let image = EnvironmentImage { name: "test".to_owned(), size, texels };
    Environment { radiance: Vec3::from_array(RADIANCE), image: Some(image) }
}

/// An octahedron: convex, seen from outside, edges and background included.
fn octahedron(albedo: f64) -> Build {
    let mut build = Build::at(3.0, dvec3(5.0, 0.0, 0.0));
    let white = build.material([albedo; 3], [0.0; 3], false);
    for [x, y, z] in [[1, 1, 1], [-1, 1, 1], [1, -1, 1], [1, 1, -1]]
        .into_iter()
        .flat_map(|s: [i32; 3]| [s, s.map(|x| -x)])
    {
        let [a, b, c] = [f64::from(x) * DVec3::X, f64::from(y) * DVec3::Y, f64::from(z) * DVec3::Z];
        let corners = if x * y * z > 0 { [a, b, c] } else { [a, c, b] };
        build.triangle(white, corners);
    }
    build.camera(dvec3(1.0, -3.0, 0.7), dvec3(-0.33, 1.0, -0.2), 40.0, [24, 24]);
    build
}

fn largest_error(image: &Image, expected: [f32; 3]) -> f32 {
    let off = |pixel: &[f32; 3]| [0, 1, 2].map(|c| (pixel[c] / expected[c] - 1.0).abs());
    image.pixels.iter().flat_map(off).fold(0.0, f32::max)
}

/// What reflects all light vanishes in light that is the same from everywhere.
#[test]
fn a_white_convex_object_vanishes_in_a_constant_environment() {
    for method in [Method::Direct, Method::Vpl, Method::Vplc, Method::Vpc, Method::Both] {
        for (samples, edge_samples) in [(1, 16), (4, 1)] {
            let mut build = octahedron(1.0);
            build.draft.environment = Some(constant());
            let settings =
                Settings { samples, edge_samples, light_paths: 100, ..Settings::of(method) };
            let frame = build.render(&settings);
            let off = largest_error(&frame.image, RADIANCE);
            assert!(off < 1e-5, "{method:?}: off by {off}");
            assert!((80..500 * u64::from(samples)).contains(&frame.counts.visible_points));
        }
    }
}

#[test]
fn a_white_convex_object_vanishes_for_paths() {
    for bounces in [Bounces::Finite(0), Bounces::Finite(2), Bounces::Unlimited] {
        let mut build = octahedron(1.0);
        build.draft.environment = Some(constant());
        let frame = build.render(&common::paths::settings(16, bounces));
        // Each path escapes at its first bounce: every sample is right.
        let off = largest_error(&frame.image, RADIANCE);
        assert!(off < 1e-5 || bounces == Bounces::Unlimited, "{bounces:?}: off by {off}");
        // Roulette takes some of the paths and gives the others more.
        let (mean, error) = mean_and_error(&frame, 0);
        assert!((mean - 2.0).abs() < 1e-5 + 4.0 * error, "{bounces:?}: {mean} ± {error}");
    }
}

/// Not convex, with unlimited bounces: a room and a block that reflect all light.
#[test]
fn a_white_room_without_roof_vanishes() {
    let mut build = Build::open_room();
    for material in &mut build.draft.materials {
        material.albedo = DVec3::ONE;
    }
    build.draft.environment = Some(constant());
    let frame = build.render(&common::paths::settings(64, Bounces::Finite(200)));
    // Now and then a path is caught beneath the block.
    let (mean, _) = mean_and_error(&frame, 0);
    assert!((mean / 2.0 - 1.0).abs() < 1e-3, "{mean}, not 2");
    let off = largest_error(&frame.image, RADIANCE);
    assert!(off < 0.05, "off by {off}");
}

/// L = ρ E / π of the plane, where the upper half of the sky is lit in part.
#[test]
fn irradiance_of_a_plane_from_a_half_lit_sky() {
    // The plane's normal is z: the image's poles are on its horizon.
    let lit = |name: &str, d: DVec3| match name {
        "half" => d.y > 0.0,
        "other half" => d.y < 0.0 || d.z < 0.0,
        _ => d.z < 0.0,
    };
    for (name, expected) in [("half", PI / 2.0), ("other half", PI / 2.0), ("below", 0.0)] {
        for size in [[256, 128], [96, 40]] {
            let mut build = plane(1.0, 1.0, 30.0, 8);
            build.draft.environment = Some(of_image(size, |x, y| {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let place = at / Vec2::new(size[0] as f32, size[1] as f32);
                if lit(name, direction(place).as_dvec3()) { Vec3::ONE } else { Vec3::ZERO }
            }));
            for (way, frame) in direct_light(&build.scene(), 1024) {
                let expected = f64::from(RADIANCE[0]) * ALBEDO[0] / PI * expected;
                let pixels = frame.image.pixels.iter().map(|pixel| f64::from(pixel[0]));
                let mean = pixels.clone().sum::<f64>() / 64.0;
                let most = if way == "path" { 0.01 } else { 3e-3 };
                let off = (mean - expected).abs();
                assert!(off <= most * expected + 1e-6, "{name}, {way}: {mean}, not {expected}");
                let off = pixels.map(|p| (p - expected).abs()).fold(0.0, f64::max);
                assert!(off <= 0.1 * expected + 1e-6, "{name}, {way}: off by {off} of {expected}");
            }
        }
    }
}

/// A bright sun and a dim sky: the image is that of the sun's cosine, for the largest image that a
/// binding holds as well.
#[test]
fn a_sun_of_few_texels() {
    for (size, wide) in [([64, 32], 1), ([1000, 700], 1), ([8192, 4096], 12)] {
        let sun = [size[0] / 16 * 15, size[1] / 2 - size[1] / 10];
        let mut build = plane(1.0, 1.0, 30.0, 8);
        let [width, height] = size.map(f64::from);
        let [top, bottom] = [sun[1], sun[1] + wide].map(|y| PI * f64::from(y) / height);
        let solid_angle = 2.0 * PI * f64::from(wide) / width * (top.cos() - bottom.cos());
        // So bright that E is about 1, if 9 bits of exponent hold it.
        let bright = (1.0 / solid_angle).min(60_000.0) as f32;
        let packed = gpu_vpl::scene::environment::unpack(pack(Vec3::splat(bright))).x;
        let in_sun = |x: u32, first: u32| (first..first + wide).contains(&x);
        build.draft.environment = Some(of_image(size, |x, y| {
            Vec3::splat(if in_sun(x, sun[0]) && in_sun(y, sun[1]) { bright } else { 0.001 })
        }));
        let middle =
            |first: u32, extent: f64| ((f64::from(first) + 0.5 * f64::from(wide)) / extent) as f32;
        let cosine =
            f64::from(direction(Vec2::new(middle(sun[0], width), middle(sun[1], height))).z);
        assert!(cosine > 0.1);
        let irradiance = f64::from(packed) * solid_angle * cosine + PI * 0.001;
        let expected = f64::from(RADIANCE[0]) * ALBEDO[0] / PI * irradiance;
        for (way, frame) in direct_light(&build.scene(), 64) {
            for pixel in &frame.image.pixels {
                let off = (f64::from(pixel[0]) / expected - 1.0).abs();
                // A texel of 64 x 32 is 6 degrees wide, and a cell by itself; in larger images the
                // sun shares cells with the sky.
                let most = if size[0] == 64 { 0.05 } else { 0.5 };
                assert!(off < most, "{size:?}, {way}: {pixel:?}, not {expected}");
            }
            let (mean, _) = mean_and_error(&frame, 0);
            let off = (mean / expected - 1.0).abs();
            assert!(off < 0.04, "{size:?}, {way}: {mean}, not {expected}");
        }
    }
}

/// What the camera sees is the texel in its direction: the device's map is the host's.
#[test]
fn the_background_is_the_image() {
    let mut rng = Rng(5);
    for size in [[37, 19], [1024, 512], [4096, 2048]] {
        let texels: Vec<Vec3> = (0..size[0] * size[1])
            .map(|_| Vec3::new(rng.unit(), rng.unit(), 30.0 * rng.unit()))
            .collect();
        let environment = of_image(size, |x, y| texels[(y * size[0] + x) as usize]);
        for (direction, up) in
            [(dvec3(0.1, 0.9, 0.2), true), (DVec3::NEG_Y, false), (dvec3(0.0, 0.1, 1.0), false)]
        {
            let mut build = octahedron(0.5);
            build.camera(dvec3(0.0, 7.0, 0.0), direction, 100.0, [64, 64]);
            // Away from the object.
            if up {
                build.camera(dvec3(0.0, 7.0, 0.0), direction, 120.0, [64, 64]);
            }
            build.draft.environment = Some(environment.clone());
            let scene = build.scene();
            let camera = scene.camera;
            let settings =
                Settings { direct: Direct::Off, edge_samples: 1, ..Settings::of(Method::Direct) };
            let prepared = Prepared::new(gpu().clone(), scene, &settings).unwrap();
            let image = frame(&prepared, &settings).image;
            let normals = frame(&prepared, &Settings { method: Method::Depth, ..settings }).image;
            let [x_scale, y_scale] = camera.half_tangents();
            let (mut wrong, mut all) = (0, 0);
            for (i, pixel) in (0..).zip(&image.pixels) {
                if normals.pixels[i as usize][0] > 0.0 {
                    continue;
                }
                let at = |i: u32| (i as f32 + 0.5) / 32.0 - 1.0;
                let ray = camera.forward + camera.right * x_scale * at(i % 64)
                    - camera.up * y_scale * at(i / 64);
                let expected = environment.from_direction(ray.normalize());
                let same = (Vec3::from_array(*pixel) - expected).abs().max_element() < 1e-5;
                wrong += u32::from(!same);
                all += 1;
            }
            // Rounding moves places by some 1e-5 of a radian, to another texel of the largest
            // image once in a hundred times.
            let most = 2 + all * size[0] / 4096 / 30;
            assert!(all > 1000 && wrong <= most, "{size:?}: {wrong} of {all} pixels differ");
        }
    }
}

/// Rays that escape at edges see the image in their own direction.
#[test]
fn antialiased_edges_see_the_background() {
    let sky = || of_image([64, 32], |x, _| Vec3::splat(if x / 2 % 2 == 0 { 1.0 } else { 0.0 }));
    let render = |samples, edge_samples| {
        let mut build = octahedron(0.0);
        build.draft.environment = Some(sky());
        build.render(&Settings { samples, edge_samples, ..Settings::of(Method::Direct) }).image
    };
    let (many, few) = (render(256, 1), render(1, 256));
    let error = |image: &Image| {
        let pairs = image.pixels.iter().zip(&many.pixels);
        // Pixels that see an edge of the object, black against white, and no stripe's.
        pairs.filter(|(a, _)| a[0] > 0.02 && a[0] < 1.98).map(|(a, b)| (a[0] - b[0]).abs()).sum()
    };
    let (smooth, count): (f32, usize) =
        (error(&few), few.pixels.iter().filter(|a| a[0] > 0.02 && a[0] < 1.98).count());
    assert!(count > 15 && smooth / (count as f32) < 0.05, "{smooth} over {count} pixels");
}

/// E times the surface of a convex object, a quarter of which is its mean projection.
#[test]
fn the_flux_of_an_environment() {
    let uneven = of_image([128, 64], |x, y| Vec3::splat((x % 5) as f32 + (y % 3) as f32));
    let even = of_image([4, 2], |_, _| Vec3::ONE);
    for (environment, factor) in [(constant(), Some(1.0)), (even, Some(1.0)), (uneven, None)] {
        let mut build = octahedron(0.5);
        build.draft.environment = Some(environment.clone());
        let scene = build.scene();
        let [flux, error] = first_flux(&scene, 1 << 16);
        let area: f64 = scene.triangles.iter().map(|t| f64::from(t.area())).sum();
        let expected = match factor {
            Some(factor) => PI * factor * area,
            // ∫ L cos dω over each triangle, by many directions.
            None => {
                let mut rng = Rng(3);
                let count = 400_000;
                let mut sum = 0.0;
                for _ in 0..count {
                    let toward = rng.direction();
                    let projected: f64 = scene
                        .triangles
                        .iter()
                        .map(|t| f64::from((0.5 * t.scaled_normal().dot(toward)).max(0.0)))
                        .sum();
                    sum += f64::from(environment.from_direction(toward).x / 2.0) * projected;
                }
                4.0 * PI * sum / f64::from(count)
            }
        };
        for channel in 0..3 {
            let expected = expected * f64::from(RADIANCE[channel]);
            let off = (flux[channel] - expected).abs();
            assert!(off < error[channel] + 2e-3 * expected, "{flux}, not {expected}, ± {error}");
        }
    }
}

#[test]
fn one_bounce_of_an_environment() {
    let sunny = of_image([256, 128], |x, y| {
        if [x, y] == [20, 60] || [x, y] == [100, 40] { Vec3::splat(3000.0) } else { Vec3::ONE }
    });
    for (name, environment) in [("constant", constant()), ("image", sunny)] {
        let mut build = Build::open_room();
        // Nothing but the room is seen.
        build.camera(dvec3(0.1, -1.6, 0.4), dvec3(0.0, 1.0, -0.35), 40.0, [16, 16]);
        build.draft.environment = Some(environment);
        one_bounce_agrees(&build.scene(), 1 << 17, name);
    }
}

/// Direct light in shadow and out of it: by samples, and by paths.
#[test]
fn direct_light_of_an_environment_is_that_of_paths() {
    let sunny = of_image([256, 128], |x, y| {
        if [x, y] == [20, 60] || [x, y] == [100, 40] { Vec3::splat(3000.0) } else { Vec3::ONE }
    });
    for (name, environment) in [("constant", constant()), ("image", sunny)] {
        let mut build = Build::open_room();
        build.draft.environment = Some(environment);
        let frames = direct_light(&build.scene(), 1024);
        let path = &frames[3].1;
        for (way, frame) in &frames[..3] {
            for channel in 0..3 {
                let (got, _) = mean_and_error(frame, channel);
                let (expected, error) = mean_and_error(path, channel);
                let off = (got / expected - 1.0).abs();
                // The samples of a pixel are in its middle, and paths everywhere.
                assert!(off < 0.02 + 4.0 * error / expected, "{name}, {way}: {got}, {expected}");
            }
        }
    }
}

/// A black environment is none; another light is needed.
#[test]
fn a_black_environment_is_left_out() {
    for black in
        [Environment { radiance: Vec3::ZERO, image: None }, of_image([4, 2], |_, _| Vec3::ZERO)]
    {
        let mut build = octahedron(0.5);
        build.draft.environment = Some(black);
        let dark = Build { draft: build.draft.clone(), ..build };
        assert!(dark.draft.finish().is_err(), "nothing shines");
        build.point_light(dvec3(0.0, -2.0, 0.0), [1.0; 3]);
        let prepared = Prepared::new(gpu().clone(), build.scene(), &Settings::default()).unwrap();
        assert!(prepared.left_out().contains(&"environment light"));
        assert!(
            frame(&prepared, &Settings::default())
                .image
                .pixels
                .iter()
                .flatten()
                .all(|c| c.is_finite())
        );
    }
}

/// Every method renders a scene that has nothing but an environment; clusters and interleaved
/// subsets included.
#[test]
fn every_method_renders_with_an_environment_alone() {
    for image in [false, true] {
        for method in Method::ALL {
            let mut build = Build::open_room();
            build.draft.environment = Some(match image {
                true => of_image([64, 32], |x, _| Vec3::splat((x % 3) as f32)),
                false => constant(),
            });
            let settings =
                Settings { light_paths: 200, clamp: Clamp::Auto, ..Settings::of(method) };
            let frame = render_scene(build.scene(), &settings);
            assert_eq!(frame.counts.nonfinite_pixels, 0);
            assert!(frame.image.pixels.iter().flatten().any(|&c| c > 0.0), "{method:?}");
        }
    }
}
