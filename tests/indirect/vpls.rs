//! Light paths: how much flux arrives where, for how many paths, and always the same.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::collections::HashSet;
use std::f64::consts::PI;

use crate::common::{Build, frame, gpu};
use glam::{DVec3, dvec3};
use gpu_vpl::bvh::Bvh;
use gpu_vpl::render::{Bounces, LightPaths, Lights, Method, Prepared, Settings, Vpl};
use gpu_vpl::scene::Scene;

fn trace(scene: &Scene, count: u32, bounces: Bounces, seed: u32) -> Vec<Vpl> {
    let (bvh, lights) = (Bvh::build(&scene.triangles), Lights::of(scene));
    LightPaths { scene, bvh: &bvh, lights: &lights, count, bounces, seed }.trace()
}

fn total<'a>(vpls: impl Iterator<Item = &'a Vpl>) -> DVec3 {
    vpls.map(|vpl| vpl.flux.as_dvec3()).sum()
}

/// Relative error of the channel that is off most.
fn off(got: DVec3, expected: DVec3) -> f64 {
    (got / expected - DVec3::ONE).abs().max_element()
}

/// A closed box with two lights in it: an area of 0.5 and a point.
fn closed_box(albedo: [f64; 3], radiance: f64, intensity: f64, two_sided: bool) -> Scene {
    let mut build = Build::new();
    let wall = build.material(albedo, [0.0; 3], false);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    if radiance > 0.0 {
        let lamp = build.material(albedo, [radiance, 0.5 * radiance, 2.0 * radiance], two_sided);
        let corner = |x, y| dvec3(x, y, 0.5);
        let quad = [corner(0.0, 0.0), corner(0.0, 0.5), corner(1.0, 0.5), corner(1.0, 0.0)];
        build.polygon(lamp, &quad.map(|p| p - dvec3(0.6, 0.0, 0.0)));
    }
    if intensity > 0.0 {
        build.point_light(dvec3(0.0, 0.0, 0.0), [intensity; 3]);
    }
    build.camera(dvec3(0.0, -0.5, 0.0), DVec3::Y, 60.0, [8, 8]);
    build.scene()
}

#[test]
fn a_closed_box_keeps_all_flux() {
    let albedo = [0.9, 0.5, 0.25];
    let area = dvec3(3.0, 1.5, 6.0) * PI * 0.5;
    let point = DVec3::splat(4.0 * PI * 0.7);
    let cases = [
        (3.0, 0.0, false, area),
        (3.0, 0.0, true, 2.0 * area),
        (0.0, 0.7, false, point),
        (3.0, 0.7, true, 2.0 * area + point),
    ];
    for (radiance, intensity, two_sided, power) in cases {
        let scene = closed_box(albedo, radiance, intensity, two_sided);
        let (paths, bounces) = (10_000, 4);
        let vpls = trace(&scene, paths, Bounces::Finite(bounces), 1);
        assert_eq!(vpls.len() as u32, paths * bounces, "a path has escaped");
        // Two lights of unlike colours share the paths by mean power: that is a stratified
        // choice, exact to one path in 10,000. Else it is f32 rounding alone.
        let tolerance = if radiance * intensity > 0.0 { 5e-4 } else { 1e-5 };
        for bounce in 0..bounces as usize {
            let arrived = total(vpls.iter().skip(bounce).step_by(bounces as usize));
            let expected = power * DVec3::from_array(albedo).powf(bounce as f64);
            let off = off(arrived, expected);
            assert!(off < tolerance, "bounce {bounce}: {arrived} instead of {expected}");
        }
    }
}

/// The sequence has blocks of 65,536 points; more paths are new paths.
#[test]
fn many_paths_do_not_repeat() {
    let scene = closed_box([0.5; 3], 0.0, 1.0, false);
    let paths = 200_000;
    let vpls = trace(&scene, paths, Bounces::Finite(1), 1);
    assert_eq!(vpls.len() as u32, paths);
    let places: HashSet<_> =
        vpls.iter().map(|vpl| vpl.position.to_array().map(f32::to_bits)).collect();
    assert!(vpls.len() - places.len() <= 2, "{} distinct places", places.len());
    assert!(off(total(vpls.iter()), DVec3::splat(4.0 * PI)) < 1e-5);
    // A light in the middle: of every part of the sequence the mean is the middle, and every
    // wall has a sixth. (Quasi-Monte Carlo: some 1e-4; 2e-3 would be that of random numbers.)
    for part in [&vpls[..65_536], &vpls[65_536..131_072], &vpls[131_072..], &vpls[..]] {
        let n = part.len() as f64;
        let mean: DVec3 = part.iter().map(|vpl| vpl.position.as_dvec3()).sum::<DVec3>() / n;
        assert!(mean.length() < 1.5e-3, "mean {mean}");
        let walls = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        for wall in walls {
            let on = part.iter().filter(|vpl| vpl.normal.as_dvec3().dot(wall) > 0.9).count();
            assert!((on as f64 / n - 1.0 / 6.0).abs() < 1e-3, "{on} of {n} on {wall}");
        }
    }
}

/// A wall of a cube gives 0.1998 of its light to the opposite one, and 0.2000 to each other:
/// so the cosine law holds, from a light as well as from a surface.
#[test]
fn the_walls_of_a_cube_have_their_form_factors() {
    let mut build = Build::new();
    let wall = build.material([1.0; 3], [0.0; 3], false);
    let lamp = build.material([1.0; 3], [1.0; 3], false);
    build.cuboid(wall, DVec3::splat(-1.0), DVec3::ONE, true);
    for triangle in &mut build.draft.triangles[8..10] {
        triangle.1 = lamp;
    }
    build.camera(dvec3(0.0, -0.5, 0.0), DVec3::Y, 60.0, [8, 8]);
    let vpls = trace(&build.scene(), 65_536, Bounces::Finite(2), 1);
    let sides = |vpl: &Vpl| vpl.normal.as_dvec3();
    // From the floor, z = -1, at the first bounce; then from wherever the light has come.
    let opposite = vpls.iter().step_by(2).filter(|vpl| sides(vpl).z < -0.9).count();
    let across = vpls.chunks(2).filter(|path| sides(&path[0]).dot(sides(&path[1])) < -0.9);
    for (bounce, count) in [(1, opposite), (2, across.count())] {
        let share = count as f64 / 65_536.0;
        // Of 65,536 random numbers the deviation is 1.6e-3; evenly spread ones are far better
        // from the light, and from a wall that is not lit evenly it is 0.2 % of another factor.
        assert!((share - 0.1998).abs() < 5e-3, "bounce {bounce}: {share}");
    }
}

fn bits(vpls: &[Vpl]) -> Vec<[u32; 13]> {
    let all = |vpl: &Vpl| {
        let vectors = [vpl.position, vpl.normal, vpl.incident, vpl.flux];
        let mut bits = [vpl.material; 13];
        for (bits, value) in bits.iter_mut().zip(vectors.iter().flat_map(|v| v.to_array())) {
            *bits = value.to_bits();
        }
        bits
    };
    vpls.iter().map(all).collect()
}

#[test]
fn paths_depend_on_the_seed_and_not_on_threads() {
    let scene = closed_box([0.8, 0.5, 0.2], 3.0, 0.7, true);
    for bounces in [Bounces::Finite(3), Bounces::Unlimited] {
        let with = |threads, seed| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            bits(&pool.install(|| trace(&scene, 5000, bounces, seed)))
        };
        let one = with(1, 1);
        assert!(one == with(2, 1) && one == with(3, 1), "threads change the paths");
        let other = with(2, 2);
        let same = one.iter().zip(&other).filter(|(a, b)| a == b).count();
        assert!(same < 5, "seeds 1 and 2 share {same} VPLs");
    }
}

/// With roulette the sum over all bounces is Φ / (1 − ρ), for every channel.
#[test]
fn roulette_keeps_the_expected_flux() {
    for albedo in [[0.8, 0.5, 0.2], [0.5; 3], [0.9, 0.1, 0.1]] {
        let scene = closed_box(albedo, 0.0, 1.0, false);
        let paths = 100_000;
        let vpls = trace(&scene, paths, Bounces::Unlimited, 1);
        let rho = DVec3::from_array(albedo);
        let arrived = total(vpls.iter());
        let expected = DVec3::splat(4.0 * PI) / (DVec3::ONE - rho);
        // A path's length has a deviation of at most √ρ of its mean: 3 of them over √100,000.
        assert!(off(arrived, expected) < 0.01, "{arrived} instead of {expected}");
        let mean = vpls.len() as f64 / f64::from(paths);
        let expected = 1.0 / (1.0 - rho.max_element());
        assert!((mean / expected - 1.0).abs() < 0.01, "{mean} bounces, not {expected}");
        // A finite number cuts the series short, and so has to differ.
        let cut = total(trace(&scene, paths, Bounces::Finite(2), 1).iter());
        assert!((cut.x / arrived.x - (1.0 - rho.x * rho.x)).abs() < 0.01);
    }
}

/// The default bound on G for a room without its front wall.
fn bound(scale: f64, paths: u32, ground: f64) -> f64 {
    let mut build = Build::at(scale, DVec3::ZERO);
    let white = build.material([0.6; 3], [0.0; 3], false);
    build.cuboid(white, DVec3::splat(-1.0), DVec3::ONE, true);
    build.draft.triangles.drain(4..6);
    if ground > 0.0 {
        let corner = |x, y| dvec3(x * ground, y * ground, -1.001);
        let plane = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        build.polygon(white, &plane);
    }
    build.point_light(dvec3(0.1, 0.2, 0.3), [1.0; 3]);
    build.camera(dvec3(0.0, -3.0, 0.0), DVec3::Y, 60.0, [8, 8]);
    let settings = Settings { light_paths: paths, ..Settings::of(Method::Vpl) };
    let prepared = Prepared::new(gpu().clone(), build.scene(), &settings).unwrap();
    frame(&prepared, &settings).counts.clamp.unwrap()
}

#[test]
fn the_default_bound_goes_with_the_density_of_vpls() {
    let base = bound(1.0, 1000, 0.0);
    // 1/length²: the paths of a scaled scene are the same but for rounding.
    for scale in [1e-6, 0.1, 4.0, 1e6] {
        let scaled = bound(scale, 1000, 0.0) * scale * scale;
        assert!((scaled / base - 1.0).abs() < 1e-2, "scale {scale}: {scaled} instead of {base}");
    }
    let factor = bound(1.0, 8000, 0.0) / base;
    assert!((5.6..10.4).contains(&factor), "8 times the paths give {factor} times the bound");
    // Most VPLs are in the room; those on the ground are few.
    for ground in [30.0, 1000.0] {
        let factor = bound(1.0, 1000, ground) / base;
        assert!((0.8..1.25).contains(&factor), "a ground plane of {ground}: {factor}");
    }
}
