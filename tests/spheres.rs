//! Spheres: rays against f64, visibility, and frames against closed forms.

#![allow(clippy::expect_used, clippy::panic, reason = "a helper of tests fails by panicking")]

mod common;

use std::f64::consts::PI;

use common::gather::visible_in;
use common::paths::mean_and_error;
use common::tracing::{on_all_of, random_rays, soup, world_of};
use common::{Build, Rng};
use glam::{DVec3, Vec3, dvec3};
use gpu_vpl::bvh::Ray;
use gpu_vpl::image::Image;
use gpu_vpl::render::kernels::Tracing;
use gpu_vpl::render::{Bounces, Clamp, Method, Settings};
use gpu_vpl::sampling::SURFACE_OFFSET;
use gpu_vpl::scene::{Scene, Sphere, Triangle};
use gpu_vpl::study::extremes::checks::gather::{point, vpl};
use gpu_vpl::study::extremes::checks::trace::Answer;

/// A scene of these shapes, as they are.
fn scene_of(triangles: Vec<Triangle>, spheres: Vec<Sphere>) -> Scene {
    let mut build = Build::new();
    let grey = build.material([0.5; 3], [0.0; 3], false);
    build.sphere(grey, DVec3::ZERO, 1.0);
    build.point_light(DVec3::Z, [1.0; 3]);
    build.camera(DVec3::X, DVec3::NEG_X, 40.0, [8, 8]);
    let mut scene = build.scene();
    scene.materials = vec![scene.materials[0].clone(); 4];
    Scene { triangles, spheres, ..scene }
}

fn random_spheres(rng: &mut Rng, count: usize, most: f32) -> Vec<Sphere> {
    let one = |_| {
        // From most to a hundred-thousandth of it.
        let radius = most * (-11.5 * rng.unit().powi(2)).exp();
        Sphere { center: rng.cube() * (1.0 - radius).max(0.0), radius, material: 2 }
    };
    (0..count).map(one).collect()
}

/// Where a ray enters and leaves a sphere, exactly; `None` if it misses it.
fn reference(ray: &Ray, sphere: &Sphere) -> Option<[f64; 2]> {
    let (o, d) = (ray.origin.as_dvec3() - sphere.center.as_dvec3(), ray.direction.as_dvec3());
    let along = -o.dot(d) / d.length_squared();
    let nearest = (o + along * d).length();
    let half = (f64::from(sphere.radius).powi(2) - nearest.powi(2)).sqrt() / d.length();
    (half >= 0.0).then_some([along - half, along + half])
}

/// What is wrong with an answer among spheres alone.
fn fault(spheres: &[Sphere], ray: &Ray, answer: &Answer) -> Option<String> {
    // By how much a sphere seen from up to 3 away may be off.
    const OFF: f64 = 1e-6;
    let length = f64::from(ray.direction.length());
    let limit = f64::from(ray.limit);
    let roots = |by: f64, sphere: &Sphere| {
        let radius = (f64::from(sphere.radius) + by) as f32;
        reference(ray, &Sphere { radius, ..*sphere }).filter(|_| radius > 0.0)
    };
    // A ray that meets a smaller sphere meets the sphere: no later than this.
    let sure = |sphere: &Sphere| {
        let (small, large) = (roots(-OFF, sphere)?, roots(OFF, sphere)?);
        let later = [small[0].max(large[0]), small[1].max(large[1])];
        let root = usize::from(large[0] * length < OFF);
        (small[root] * length > OFF && later[root] < limit).then_some(later[root])
    };
    let nearest = spheres.iter().filter_map(sure).fold(f64::INFINITY, f64::min);
    if !answer.hits() {
        return (nearest < limit - 1e-3 / length).then(|| format!("misses a hit at {nearest}"));
    }
    let t = f64::from(answer.t);
    let sphere = spheres.get(answer.triangle as usize)?;
    if t > nearest + OFF / length + 1e-6 * nearest {
        return Some(format!("hits at {t} beyond {nearest}"));
    }
    let place = ray.origin.as_dvec3() + t * ray.direction.as_dvec3();
    let radius = place.distance(sphere.center.as_dvec3());
    let off = (radius - f64::from(sphere.radius)).abs();
    // A grazing ray is near the surface for long: there t is worth less.
    if off > 2.0 * OFF {
        return Some(format!("hits {off} beside a sphere of {}", sphere.radius));
    }
    let normal = Vec3::from_array(answer.weights).as_dvec3();
    let placed = sphere.center.as_dvec3() + f64::from(sphere.radius) * normal;
    let lost = ray.origin.as_dvec3() - placed;
    let d = ray.direction.as_dvec3().normalize();
    let beside = (lost - lost.dot(d) * d).length();
    (beside > OFF || (normal.length() - 1.0).abs() > 1e-6)
        .then(|| format!("the normal puts it {beside} beside the ray"))
}

/// Spheres from large to tiny, from near and afar, from inside and outside, with directions of any
/// length: host and device are right, and alike.
#[test]
fn rays_meet_spheres() {
    let mut rng = Rng(1);
    for (count, most) in [(1, 1.0), (2, 0.5), (40, 0.5), (2000, 0.1)] {
        let spheres = random_spheres(&mut rng, count, most);
        let mut rays = random_rays(&mut rng, 1000);
        for i in 0..2000 {
            let sphere = &spheres[rng.below(count)];
            let (out, origin) = (rng.direction(), rng.cube());
            let on = sphere.center + sphere.radius * out;
            let ray = match i % 5 {
                // At the sphere, at its rim, from its middle, off its surface to either side.
                0 => (origin, on - origin, f32::MAX),
                1 => (origin, 1e-5 * (on - origin), f32::MAX),
                2 => (sphere.center, 1e5 * out, f32::MAX),
                3 => (on + SURFACE_OFFSET * out, rng.direction(), 3.0),
                _ => (on - SURFACE_OFFSET * out, rng.direction(), 3.0),
            };
            rays.push(Ray { origin: ray.0, direction: ray.1, limit: ray.2 });
        }
        let world = world_of(&scene_of(Vec::new(), spheres.clone()));
        let sides = on_all_of(&world, &rays, false);
        for (side, answers) in &sides {
            for (ray, answer) in rays.iter().zip(answers) {
                let fault = fault(&spheres, ray, answer);
                assert_eq!(fault, None, "{side}, {count} spheres: {ray:?}, {answer:?}");
            }
            let differ = sides[0].1.iter().zip(answers).filter(|(a, b)| a.hits() != b.hits());
            assert!(differ.count() <= 3, "{side} differs from the host");
            assert!(answers.iter().filter(|answer| answer.hits()).count() > 500, "few hits");
            assert!(answers.iter().all(|a| !a.hits() || a.material == 2));
        }
        for (side, any) in on_all_of(&world, &rays, true) {
            let differ = sides[0].1.iter().zip(&any).filter(|(a, b)| a.hits() != b.hits());
            assert!(differ.count() <= 3, "{side}: any hit differs from the closest");
        }
    }
}

/// Among both the nearest is hit, as if they were traced by themselves.
#[test]
fn triangles_and_spheres_in_one_hierarchy() {
    let mut rng = Rng(2);
    let mut hits = [0; 2];
    for (triangles, spheres) in [(1, 1), (1, 50), (300, 3), (500, 500)] {
        let triangles = soup(&mut rng, triangles, 0.3);
        let spheres = random_spheres(&mut rng, spheres, 0.2);
        let rays = random_rays(&mut rng, 3000);
        let trace = |triangles: &[Triangle], spheres: &[Sphere], any| {
            on_all_of(&world_of(&scene_of(triangles.to_vec(), spheres.to_vec())), &rays, any)
        };
        for any in [false, true] {
            let (flat, round) = (trace(&triangles, &[], any), trace(&[], &spheres, any));
            let both = trace(&triangles, &spheres, any);
            for ((side, both), (flat, round)) in both.iter().zip(flat.iter().zip(&round)) {
                for (i, answer) in both.iter().enumerate() {
                    let (flat, mut round) = (flat.1[i], round.1[i]);
                    if any {
                        assert_eq!(answer.hits(), flat.hits() || round.hits(), "{side}");
                        continue;
                    }
                    round.triangle = round.triangle.saturating_add(triangles.len() as u32);
                    let nearer = if !round.hits() || flat.t <= round.t && flat.hits() {
                        flat
                    } else {
                        round
                    };
                    let same = (answer.t, answer.triangle) == (nearer.t, nearer.triangle);
                    assert!(
                        same || !answer.hits() && !nearer.hits(),
                        "{side}: {answer:?}, {nearer:?}"
                    );
                    if answer.hits() {
                        hits[usize::from(answer.triangle as usize >= triangles.len())] += 1;
                    }
                }
            }
        }
    }
    assert!(hits[0] > 1000 && hits[1] > 1000, "{hits:?}");
}

/// All kernels of the visibility pass, and the host, among triangles and spheres.
#[test]
fn visibility_among_spheres() {
    let mut rng = Rng(3);
    let (triangles, spheres) = (soup(&mut rng, 20, 0.4), random_spheres(&mut rng, 20, 0.3));
    let world = world_of(&scene_of(triangles, spheres.clone()));
    let mut place = || {
        let (sphere, out) = (&spheres[rng.below(spheres.len())], rng.direction());
        (sphere.center + sphere.radius * out, if rng.unit() < 0.8 { out } else { -out })
    };
    let points: Vec<_> = (0..300).map(|_| place()).collect();
    let vpls: Vec<_> = (0..64).map(|_| place()).collect();
    let point_records: Vec<_> = points.iter().map(|&(p, n)| point(p, n)).collect();
    let vpl_records: Vec<_> = vpls.iter().map(|&(p, n)| vpl(p, n, Vec3::ONE)).collect();
    let subgroups = common::gpu().has_subgroups();
    let packets = [Tracing::Shaft, Tracing::Rays].into_iter().filter(|_| subgroups);
    for tracing in [Tracing::Single].into_iter().chain(packets) {
        let (bits, _) = visible_in(&world, tracing, &point_records, &vpl_records);
        let (mut seen, mut blocked, mut wrong) = (0, 0, 0);
        for (j, &(s, m)) in vpls.iter().enumerate() {
            for (i, &(x, n)) in points.iter().enumerate() {
                let faces = (x - s).dot(n) < 0.0 && (x - s).dot(m) > 0.0;
                let (origin, end) = (s + SURFACE_OFFSET * m, x + SURFACE_OFFSET * n);
                let ray = Ray { origin, direction: end - origin, limit: 1.0 };
                let expected = faces && !world.bvh.occluded(&ray);
                let got = bits[j / 32 * points.len() + i] >> (j % 32) & 1 == 1;
                wrong += u32::from(got != expected);
                *(if expected { &mut seen } else { &mut blocked }) += u32::from(faces);
            }
        }
        assert!(wrong <= 2, "{tracing:?}: {wrong} bits differ from the host");
        assert!(seen > 500 && blocked > 500, "{seen} seen, {blocked} blocked");
    }
}

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
fn wrong_answers_are_seen() {
    let spheres = [Sphere { center: Vec3::ZERO, radius: 0.5, material: 2 }];
    let ray = Ray { origin: Vec3::new(0.1, 0.2, 2.0), direction: Vec3::NEG_Z, limit: f32::MAX };
    let world = world_of(&scene_of(Vec::new(), spheres.to_vec()));
    let right = on_all_of(&world, &[ray], false)[0].1[0];
    assert_eq!(fault(&spheres, &ray, &right), None);
    assert!(fault(&spheres, &ray, &Answer { t: right.t * 1.00001, ..right }).is_some());
    let turned = [right.weights[1], right.weights[0], right.weights[2]];
    assert!(fault(&spheres, &ray, &Answer { weights: turned, ..right }).is_some());
    assert!(fault(&spheres, &ray, &Answer { triangle: u32::MAX, ..right }).is_some());
    let image = Image { width: 1, height: 1, pixels: vec![[1.0, 2.0, 3.0]] };
    assert!(farthest(&image, [1.0, 2.0, 3.003]) > 9e-4);
}
