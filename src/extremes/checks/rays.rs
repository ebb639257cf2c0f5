//! Rays against closed surfaces and along the faces of boxes.

use std::f32::consts::{PI, TAU};

use glam::{Mat3, Vec3};

use super::measure::none;
use super::random::Rng;
use super::trace::{World, on_all};
use crate::bvh::{Bvh, Ray};
use crate::error::Error;
use crate::extremes::{Figure, Scale};
use crate::gpu::Gpu;
use crate::scene::Triangle;

/// A closed surface that is star-shaped about the origin, with its name.
type Closed = (&'static str, Vec<Triangle>);

/// Closed surfaces let no ray from inside out, wherever it is aimed: at faces, edges, vertices.
pub fn leaks(gpu: &Gpu, scale: Scale) -> Result<Vec<Figure>, Error> {
    let rays = if scale == Scale::Full { 1_000_000 } else { 100_000 };
    let mut random = Rng(4);
    let turned =
        Mat3::from_rotation_x(0.3) * Mat3::from_rotation_y(1.1) * Mat3::from_rotation_z(2.0);
    let surfaces: [Closed; 5] = [
        ("box", cube(1, Mat3::IDENTITY)),
        ("turned box", cube(1, turned)),
        ("box of 432 triangles", cube(6, turned)),
        ("sphere of triangles", ball(24, |_| 1.0)),
        ("random closed mesh", ball(24, |_| 0.4 + 0.6 * random.unit())),
    ];
    let mut figures = Vec::new();
    for (name, triangles) in &surfaces {
        let world = World::of_triangles(gpu, &Bvh::build(triangles))?;
        for (target, aim) in TARGETS {
            let share = rays / TARGETS.len();
            let rays: Vec<Ray> =
                (0..share).map(|i| aimed(&mut random, triangles, *aim, i)).collect();
            for any in [false, true] {
                for (side, answers) in on_all(gpu, &world, &rays, any)? {
                    let leaks = answers.iter().filter(|answer| !answer.hits()).count();
                    let hits = if any { "any hit" } else { "nearest hit" };
                    let what = format!("{name}, {share} rays at {target}, {side}, {hits}: leaks");
                    figures.push(none(what, leaks));
                }
            }
        }
    }
    Ok(figures)
}

/// Where on a triangle a ray is aimed.
type Aim = fn(&mut Rng, &Triangle) -> Vec3;

const TARGETS: &[(&str, Aim)] = &[
    ("faces", |random, face| random.on(face)),
    ("edges", |random, face| {
        let [a, b, _] = face.vertices;
        a + (b - a) * random.unit()
    }),
    ("vertices", |_, face| face.vertices[0]),
];

/// From near the origin. Some start level with their target, so that components of direction
/// are zero.
fn aimed(random: &mut Rng, triangles: &[Triangle], aim: Aim, index: usize) -> Ray {
    /// All surfaces are farther from the origin.
    const INSIDE: f32 = 0.15;
    let face = random.below(triangles.len());
    let target = aim(random, &triangles[face]);
    let mut origin = INSIDE * random.cube();
    let axis = random.below(3);
    if index.is_multiple_of(7) && target[axis].abs() < INSIDE {
        origin[axis] = target[axis];
    }
    Ray { origin, direction: target - origin, limit: f32::MAX }
}

fn triangle(vertices: [Vec3; 3]) -> Triangle {
    Triangle { vertices, material: 0 }
}

/// The surface of a cube, each face of n × n quads, turned.
pub fn cube(n: u32, turn: Mat3) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let at = |i: u32, j: u32| {
                let mut p = [0.0; 3];
                let on = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, on(i), on(j));
                turn * (0.8 * Vec3::from_array(p))
            };
            for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
                let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                triangles.push(triangle([quad[0], quad[1], quad[2]]));
                triangles.push(triangle([quad[0], quad[2], quad[3]]));
            }
        }
    }
    triangles
}

/// A sphere of `n` rings, each vertex at its own distance from the centre.
fn ball(n: u32, mut radius: impl FnMut(u32) -> f32) -> Vec<Triangle> {
    let vertices: Vec<Vec3> = (0..2 * n * (n + 1))
        .map(|index| {
            let (turn, polar) = (index % (2 * n), index / (2 * n));
            let (turn, polar) = (TAU * turn as f32 / (2 * n) as f32, PI * polar as f32 / n as f32);
            let direction =
                Vec3::new(polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos());
            0.9 * radius(index) * direction
        })
        .collect();
    // The rings at the poles are one vertex each.
    let at = |turn: u32, polar: u32| match polar {
        0 => vertices[0],
        polar if polar == n => vertices[(2 * n * n) as usize],
        polar => vertices[(polar * 2 * n + turn % (2 * n)) as usize],
    };
    let mut triangles = Vec::new();
    for (turn, polar) in (0..2 * n * n).map(|k| (k % (2 * n), k / (2 * n))) {
        let quad =
            [at(turn, polar), at(turn, polar + 1), at(turn + 1, polar + 1), at(turn + 1, polar)];
        if polar + 1 < n {
            triangles.push(triangle([quad[0], quad[1], quad[2]]));
        }
        if polar > 0 {
            triangles.push(triangle([quad[0], quad[2], quad[3]]));
        }
    }
    triangles
}

/// Rays in the plane of a box's face, where a slab test has 0 · ∞, meet what touches the face.
pub fn in_faces(gpu: &Gpu, _: Scale) -> Result<Vec<Figure>, Error> {
    let (triangles, rays) = tips();
    let world = World::of_triangles(gpu, &Bvh::build(&triangles))?;
    let mut figures = Vec::new();
    for (side, answers) in on_all(gpu, &world, &rays, false)? {
        let missed = |(i, _): &(usize, _)| answers[*i].triangle != *i as u32 / 2;
        let missed = rays.iter().enumerate().filter(missed).count();
        figures.push(none(format!("{} rays in faces, {side}: missed", rays.len()), missed));
        let unlike = answers.iter().filter(|answer| !answer.t.is_finite()).count();
        figures.push(none(format!("{side}: distances that are no number"), unlike));
    }
    Ok(figures)
}

/// Six triangles far from each other, each across an axis with its tip to one side, and two rays
/// that meet each tip: their other components are 0, or −0. All products of the test are exact.
fn tips() -> (Vec<Triangle>, Vec<Ray>) {
    let (mut triangles, mut rays) = (Vec::new(), Vec::new());
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let turn = |x: f32, y: f32, z: f32| {
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (x, y, z);
                Vec3::from_array(p)
            };
            let far = 8.0 * turn(0.0, 0.0, side);
            let corners = [turn(0.0, -1.0, -side), turn(0.0, 1.0, -side), turn(0.0, 0.0, side)];
            triangles.push(triangle(corners.map(|corner| far + corner)));
            for zero in [0.0, -0.0] {
                let (origin, direction) = (far + turn(-2.0, 0.0, side), turn(1.0, zero, zero));
                rays.push(Ray { origin, direction, limit: f32::MAX });
            }
        }
    }
    (triangles, rays)
}
