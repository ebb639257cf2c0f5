//! Light paths that start where their light counts: they carry the same light, and a house in a square
//! kilometre of ground gets as many as the house alone.

#![allow(clippy::unwrap_used, reason = "a helper of tests fails by panicking")]

use std::f64::consts::PI;

use crate::common::{Build, Rng};
use glam::{DVec3, Vec2, Vec3, dvec3};
use gpu_vpl::bvh::Bvh;
use gpu_vpl::render::materials::hit::Facet;
use gpu_vpl::render::{Bounces, LightPaths, Lights, Starts, Vpl};
use gpu_vpl::scene::environment::{pack, place as place_of};
use gpu_vpl::scene::{Environment, EnvironmentImage, Scene};

const SEEDS: u32 = 12;
/// Half of the room's edges; the window is a square of edge 1 in the wall of greatest x.
const ROOM: DVec3 = dvec3(3.0, 2.5, 1.3);
const SUN: DVec3 = dvec3(-1.0, 0.25, -0.5);

/// A room with a window in a wall, on black ground of some half-edge, lit by sun and sky.
fn house(ground: f64, sky: f64, sun: f64, lamp: f64) -> Scene {
    let mut build = Build::new();
    let wall = build.material([0.6; 3], [0.0; 3], false);
    let black = build.material([0.0; 3], [0.0; 3], false);
    build.cuboid(wall, -ROOM, ROOM, true);
    // The wall of greatest x.
    build.draft.triangles.drain(2..4);
    let corner = |y: f64, z: f64| dvec3(ROOM.x, y, z);
    let mut part = |y: [f64; 2], z: [f64; 2]| {
        let [a, b] = [0, 1].map(|i| corner(y[i], z[0]));
        let [c, d] = [1, 0].map(|i| corner(y[i], z[1]));
        build.polygon(wall, &[a, b, c, d]);
    };
    part([-ROOM.y, -0.5], [-ROOM.z, ROOM.z]);
    part([0.5, ROOM.y], [-ROOM.z, ROOM.z]);
    part([-0.5, 0.5], [-ROOM.z, -0.5]);
    part([-0.5, 0.5], [0.5, ROOM.z]);
    let corner = |x: f64, y: f64| dvec3(x * ground, y * ground, -ROOM.z - 0.01);
    let plane = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    build.polygon(black, &plane);
    if sky > 0.0 {
        build.draft.environment =
            Some(Environment { radiance: Vec3::splat(sky as f32), image: None });
    }
    if sun > 0.0 {
        build.directional_light(SUN, [sun; 3]);
    }
    if lamp > 0.0 {
        build.point_light(DVec3::ZERO, [lamp; 3]);
    }
    build.camera(dvec3(-2.5, 0.0, 0.0), DVec3::X, 70.0, [8, 8]);
    build.scene()
}

/// Places on the walls, the floor and the ceiling.
fn seen(scene: &Scene) -> Vec<Facet> {
    let mut rng = Rng(7);
    let place = |i: usize| {
        let mut at = rng.cube().as_dvec3() * ROOM;
        let (axis, side) = (i % 3, if i.is_multiple_of(2) { 1.0 } else { -1.0 });
        at[axis] = side * ROOM[axis];
        let normal = -side * DVec3::AXES[axis];
        let window = at.x > 2.99 && at.y.abs() < 0.5 && at.z.abs() < 0.5;
        let position = scene.units.normalise(at).as_vec3();
        (!window).then(|| Facet { position, normal: normal.as_vec3() })
    };
    (0..65_536).filter_map(place).collect()
}

/// VPLs in the room.
fn trace(scene: &Scene, learned: bool, count: u32, seed: u32) -> Vec<Vpl> {
    let (bvh, lights) = (Bvh::of(scene), Lights::of(scene));
    let starts =
        learned.then(|| Starts::learned(scene, &bvh, &lights, &seen(scene), seed).unwrap());
    let bounces = Bounces::Finite(3);
    let paths = LightPaths { scene, bvh: &bvh, lights: &lights, count, bounces, seed };
    let inside = |vpl: &Vpl| {
        let place = place(scene, vpl);
        (place.abs() - ROOM).max_element() < 1e-3 && place.dot(vpl.normal.as_dvec3()) < 0.0
    };
    paths.trace_from(starts.as_ref()).into_iter().filter(inside).collect()
}

fn place(scene: &Scene, vpl: &Vpl) -> DVec3 {
    vpl.position.as_dvec3() * scene.units.scale + scene.units.center
}

/// What arrives in the room with each bounce [W].
fn flux(scene: &Scene, vpls: &[Vpl]) -> DVec3 {
    let watts = |vpl: &Vpl| f64::from(vpl.flux.x) * scene.units.scale.powi(2);
    vpls.iter().map(|vpl| DVec3::AXES[vpl.bounce as usize - 1] * watts(vpl)).sum()
}

/// The mean over seeds and its standard error.
fn mean(of: impl Fn(u32) -> DVec3) -> [DVec3; 2] {
    let all: Vec<DVec3> = (0..SEEDS).map(of).collect();
    let count = f64::from(SEEDS);
    let mean = all.iter().sum::<DVec3>() / count;
    let squares = all.iter().map(|one| (one - mean).powf(2.0)).sum::<DVec3>();
    [mean, (squares / (count * (count - 1.0))).map(f64::sqrt)]
}

#[test]
fn learned_starts_carry_the_light_that_comes_through_a_window() {
    // A window of 1 m² that sees the sun and half of the sky.
    let sun = 10.0 * SUN.normalize().x.abs();
    for (ground, sky, sun, lamp, expected) in [
        (12.0, 0.0, 10.0, 0.0, sun),
        (500.0, 0.0, 10.0, 0.0, sun),
        (500.0, 2.0, 0.0, 0.0, PI),
        (500.0, 2.0, 10.0, 0.5, sun + PI + 0.5 * 4.0 * PI),
    ] {
        let scene = house(ground, sky, sun, lamp);
        let [mean, error] = mean(|seed| flux(&scene, &trace(&scene, true, 8000, seed)));
        let off = (mean.x - expected).abs();
        eprintln!("ground {ground}: {mean} ± {error}, first {expected}");
        assert!(off < 4.0 * error.x + 0.01 * expected, "{mean} ± {error}, not {expected}");
        assert!(error.x < 0.05 * expected, "noise of {error} hides an error");
    }
}

/// A dim sky with a bright patch that shines through the window.
fn uneven_sky() -> Environment {
    let (width, height) = (64, 32);
    let toward = place_of((-SUN).normalize().as_vec3());
    let texel = |i: u32| {
        let at = Vec2::new((i % width) as f32 / 64.0, (i / width) as f32 / 32.0);
        pack(Vec3::splat(if at.distance(toward) < 0.05 { 300.0 } else { 1.0 }))
    };
    let texels = (0..width * height).map(texel).collect();
    let image = EnvironmentImage { name: String::new(), size: [width, height], texels };
    Environment { radiance: Vec3::splat(0.5), image: Some(image) }
}

#[test]
fn learned_starts_carry_what_plain_ones_do() {
    let mut uneven = house(12.0, 2.0, 0.0, 0.5);
    uneven.environment = Some(uneven_sky());
    for scene in [house(12.0, 2.0, 10.0, 0.5), uneven] {
        let [learned, plain] = [(true, 8000), (false, 200_000)].map(|(learned, count)| {
            mean(|seed| flux(&scene, &trace(&scene, learned, count, seed)))
        });
        eprintln!("{learned:?} {plain:?}");
        for bounce in 0..3 {
            let off = (learned[0] - plain[0])[bounce].abs();
            let error = learned[1][bounce].hypot(plain[1][bounce]);
            assert!(off < 4.0 * error, "bounce {}: {learned:?} and {plain:?}", bounce + 1);
            assert!(error < 0.05 * plain[0][bounce]);
        }
    }
}

/// The root of the mean variance over seeds of what parts of the walls get, over the mean.
fn spread(ground: f64) -> f64 {
    let scene = house(ground, 2.0, 10.0, 0.0);
    let parts = |seed| {
        let mut parts = vec![0.0; 4 * 4 * 4];
        for vpl in trace(&scene, true, 8000, seed) {
            let cell = ((place(&scene, &vpl) / ROOM * 0.499 + 0.5) * 4.0).floor();
            parts[(cell.x * 16.0 + cell.y * 4.0 + cell.z) as usize] +=
                f64::from(vpl.flux.x) * scene.units.scale.powi(2);
        }
        parts
    };
    let all: Vec<Vec<f64>> = (0..SEEDS).map(parts).collect();
    let count = f64::from(SEEDS);
    let (mut variance, mut square) = (0.0, 0.0);
    for part in 0..64 {
        let mean = all.iter().map(|one| one[part]).sum::<f64>() / count;
        variance += all.iter().map(|one| (one[part] - mean).powi(2)).sum::<f64>() / (count - 1.0);
        square += mean * mean;
    }
    (variance / square).sqrt()
}

#[test]
fn a_house_in_a_square_kilometre_is_lit_as_well_as_alone() {
    let [alone, with_ground] = [12.0, 500.0].map(spread);
    eprintln!("spread {alone}, with ground {with_ground}");
    assert!(with_ground < 1.5 * alone, "{with_ground} with ground, {alone} alone");
}

#[test]
fn learned_starts_do_not_depend_on_threads() {
    let scene = house(500.0, 2.0, 10.0, 0.5);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| trace(&scene, true, 2000, 1))
    };
    let one = with(1);
    assert!(!one.is_empty() && one == with(2) && one == with(3));
}

#[test]
fn nothing_is_learned_where_no_light_is_far_away() {
    let scene = house(12.0, 0.0, 0.0, 1.0);
    let (bvh, lights) = (Bvh::of(&scene), Lights::of(&scene));
    assert!(Starts::learned(&scene, &bvh, &lights, &seen(&scene), 1).is_none());
}
