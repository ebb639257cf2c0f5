//! A vaulted hall: fluted columns, statues on pedestals, shelves and stairs. Its lamps lie
//! on the cornices and shine at the vault, so that nearly all light in it is indirect.
//! Metres, y up; the camera stands at low z and looks along the hall.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, dvec2, dvec3};

use super::shapes::Shapes;
use crate::scene::{Draft, DraftCamera, FovAxis, Origin, SceneError};

const HALF_WIDTH: f64 = 6.0;
const LENGTH: f64 = 24.0;
const WALL: f64 = 5.0;
const RISE: f64 = 2.4;

/// z of the columns, on both sides.
const BAYS: [f64; 6] = [2.4, 6.2, 10.0, 13.8, 17.6, 21.4];
const COLUMN_X: f64 = 4.2;

struct Materials {
    plaster: u32,
    terracotta: u32,
    teal: u32,
    marble: u32,
    slate: u32,
    wood: u32,
    gold: u32,
    books: [u32; 4],
    lamp: u32,
    panel: u32,
}

/// Builds the hall.
pub fn build(draft: &mut Draft) -> Result<(), SceneError> {
    let mut shapes = Shapes { draft };
    let materials = materials(&mut shapes)?;
    shell(&mut shapes, &materials);
    cornices(&mut shapes, &materials);
    columns(&mut shapes, &materials);
    statues(&mut shapes, &materials);
    shelves(&mut shapes, &materials);
    stairs(&mut shapes, &materials);
    // A reading lamp above the platform at the far end.
    draft.point_lights.push((dvec3(1.2, 3.1, 21.5), dvec3(14.0, 10.0, 6.0)));
    draft.camera = Some(DraftCamera {
        position: dvec3(-1.6, 1.9, 0.5),
        direction: dvec3(0.13, -0.02, 1.0),
        up: DVec3::Y,
        fov: 62.0,
        fov_axis: FovAxis::Smaller,
        size: [512, 512],
        origin: Origin::file(&draft.name),
    });
    Ok(())
}

fn materials(shapes: &mut Shapes) -> Result<Materials, SceneError> {
    Ok(Materials {
        plaster: shapes.diffuse("plaster", [0.82, 0.79, 0.73])?,
        terracotta: shapes.diffuse("terracotta", [0.66, 0.24, 0.13])?,
        teal: shapes.diffuse("teal", [0.12, 0.42, 0.45])?,
        marble: shapes.diffuse("marble", [0.78, 0.76, 0.74])?,
        slate: shapes.diffuse("slate", [0.22, 0.22, 0.25])?,
        wood: shapes.diffuse("wood", [0.45, 0.28, 0.14])?,
        gold: shapes.diffuse("gold", [0.80, 0.58, 0.18])?,
        books: [
            shapes.diffuse("book red", [0.55, 0.10, 0.09])?,
            shapes.diffuse("book green", [0.12, 0.34, 0.16])?,
            shapes.diffuse("book blue", [0.11, 0.17, 0.45])?,
            shapes.diffuse("book ivory", [0.76, 0.70, 0.55])?,
        ],
        lamp: shapes.light("cornice lamp", [0.0; 3], [17.0, 14.3, 10.4])?,
        panel: shapes.light("panel lamp", [0.0; 3], [7.0, 8.5, 10.5])?,
    })
}

/// Floor, walls and the vault, facing inward.
fn shell(shapes: &mut Shapes, m: &Materials) {
    let (width, length) = (2.0 * HALF_WIDTH * DVec3::X, LENGTH * DVec3::Z);
    let near_left = dvec3(-HALF_WIDTH, 0.0, 0.0);
    let tile =
        |i: usize, j: usize| if (i / 2 + j / 2).is_multiple_of(2) { m.marble } else { m.slate };
    shapes.grid([near_left, length, width], [96, 48], |j, i| tile(i, j));

    let up = WALL * DVec3::Y;
    let near_right = near_left + width;
    shapes.grid([near_left, up, length], [20, 96], |_, _| m.terracotta);
    shapes.grid([near_right, length, up], [96, 20], |_, _| m.teal);
    for (corner, u) in [(near_right, -width), (near_left + length, width)] {
        // An end wall follows the vault.
        shapes.surface(
            [48, 24],
            |_, _| m.plaster,
            |s, t| corner + s * u + t * (WALL + RISE * (PI * s).sin()) * DVec3::Y,
        );
    }
    shapes.surface(
        [96, 48],
        |_, _| m.plaster,
        |t, s| near_left + s * width + t * length + (WALL + RISE * (PI * s).sin()) * DVec3::Y,
    );
}

/// Ledges along the walls that hide upward lamps, and three panels that shine down.
fn cornices(shapes: &mut Shapes, m: &Materials) {
    let (height, depth) = (4.3, 0.8);
    for side in [-1.0, 1.0] {
        let [low, high] = match side < 0.0 {
            true => [-HALF_WIDTH, -HALF_WIDTH + depth],
            false => [HALF_WIDTH - depth, HALF_WIDTH],
        };
        shapes.block(m.plaster, dvec3(low, height, 0.0), dvec3(high, height + 0.12, LENGTH));
        for z in BAYS {
            let lamp = dvec3(0.5 * (low + high) - 0.17, height + 0.17, z - 1.4);
            let (u, v) = (2.8 * DVec3::Z, 0.34 * DVec3::X);
            shapes.quad(m.lamp, [lamp, lamp + u, lamp + u + v, lamp + v]);
        }
    }
    for z in [6.0, 12.0, 18.0] {
        let panel = dvec3(-0.5, 5.2, z - 0.5);
        shapes.block(m.wood, panel, panel + dvec3(1.0, 0.05, 1.0));
        let below = panel - 0.01 * DVec3::Y;
        shapes.quad(
            m.panel,
            [below, below + DVec3::X, below + DVec3::X + DVec3::Z, below + DVec3::Z],
        );
    }
}

/// Two rows of fluted columns.
fn columns(shapes: &mut Shapes, m: &Materials) {
    let height = WALL + 0.9;
    let shaft: Vec<DVec2> = (0..=20)
        .map(|i| {
            let t = f64::from(i) / 20.0;
            // Entasis: the shaft swells a little below its middle.
            dvec2(0.30 - 0.05 * t + 0.025 * (PI * t).sin(), 0.35 + t * (height - 0.65))
        })
        .collect();
    let base = [
        (0.0, 0.0),
        (0.46, 0.0),
        (0.46, 0.12),
        (0.40, 0.16),
        (0.42, 0.24),
        (0.33, 0.35),
        (0.0, 0.35),
    ];
    let capital = [
        (0.0, 0.0),
        (0.25, 0.0),
        (0.31, 0.08),
        (0.38, 0.18),
        (0.44, 0.22),
        (0.44, 0.30),
        (0.0, 0.30),
    ];
    let [base, capital] = [base, capital].map(|profile| profile.map(|(r, y)| dvec2(r, y)));
    for z in BAYS {
        for x in [-COLUMN_X, COLUMN_X] {
            let foot = dvec3(x, 0.0, z);
            shapes.lathe(m.marble, foot, &shaft, 80, (20, 0.10));
            shapes.lathe(m.marble, foot, &base, 40, (0, 0.0));
            shapes.lathe(m.marble, foot + (height - 0.3) * DVec3::Y, &capital, 40, (0, 0.0));
        }
    }
}

/// A torus knot in the middle, spheres and pebbles along the aisles.
fn statues(shapes: &mut Shapes, m: &Materials) {
    let pedestal = |shapes: &mut Shapes, x: f64, z: f64, half: f64, height: f64| {
        let (low, high) = (dvec3(x - half, 0.0, z - half), dvec3(x + half, height, z + half));
        shapes.block(m.slate, low, high);
        let rim = dvec3(0.06, 0.0, 0.06);
        shapes.block(m.slate, dvec3(low.x, height, low.z) - rim, high + rim + 0.06 * DVec3::Y);
    };
    pedestal(shapes, 0.6, 7.0, 0.65, 0.7);
    shapes.knot(m.gold, dvec3(0.6, 1.32, 7.0), 0.55, 0.15, [288, 32]);
    for (i, &z) in BAYS.iter().enumerate().take(5) {
        let middle = z + 1.9;
        for (x, smooth) in [(-COLUMN_X, i % 2 == 0), (COLUMN_X, i % 2 == 1)] {
            pedestal(shapes, x, middle, 0.38, 0.9);
            let center = dvec3(x, 1.41, middle);
            let bumps = 7.0 + i as f64;
            shapes.ball(if smooth { m.marble } else { m.gold }, center, 40, |d| {
                let wave = (bumps * d.x).sin() * (bumps * d.y).sin() * (bumps * d.z + 1.0).sin();
                if smooth { 0.42 } else { 0.36 + 0.09 * wave }
            });
        }
    }
}

/// Bookshelves along both walls between the columns.
fn shelves(shapes: &mut Shapes, m: &Materials) {
    let (depth, length, rows, row) = (0.38, 2.0, 5, 0.46);
    for (bay, z) in BAYS.iter().enumerate().take(5) {
        let from = z + 0.9;
        for side in [-1.0, 1.0] {
            // From the wall (0) towards the hall (1).
            let x = |t: f64| side * (HALF_WIDTH - 0.01 - t * depth);
            let span = |a: f64, b: f64| (x(a).min(x(b)), x(a).max(x(b)));
            let mut slab = |material, (x0, x1): (f64, f64), y: [f64; 2], z: [f64; 2]| {
                shapes.block(material, dvec3(x0, y[0], z[0]), dvec3(x1, y[1], z[1]));
            };
            let top = rows as f64 * row + 0.04;
            for end in [from - 0.04, from + length] {
                slab(m.wood, span(0.0, 1.0), [0.0, top], [end, end + 0.04]);
            }
            for i in 0..=rows {
                let y = i as f64 * row;
                slab(m.wood, span(0.0, 0.99), [y, y + 0.04], [from, from + length]);
            }
            for i in 0..rows {
                let mut at = from + 0.03;
                for book in 0.. {
                    let [thick, tall, deep, color] = variety(bay, side < 0.0, i, book);
                    let end = at + 0.03 + 0.05 * thick;
                    if end > from + length - 0.02 {
                        break;
                    }
                    let y = i as f64 * row + 0.041;
                    let color = m.books[((4.0 * color) as usize).min(3)];
                    let across = span(0.1, 0.6 + 0.3 * deep);
                    slab(color, across, [y, y + 0.24 + 0.14 * tall], [at, end]);
                    at = end + 0.004;
                }
            }
        }
    }
}

/// Four numbers in [0, 1) that look random and are the same everywhere.
fn variety(bay: usize, left: bool, row: usize, book: usize) -> [f64; 4] {
    let mut state = ((bay * 2 + usize::from(left)) * 64 + row) as u32 * 4096 + book as u32;
    [(); 4].map(|()| {
        // PCG's output function (O'Neill 2014) on a counter.
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        f64::from((word >> 22) ^ word) / 4_294_967_296.0
    })
}

/// Steps up to a platform at the far end.
fn stairs(shapes: &mut Shapes, m: &Materials) {
    let (steps, run, rise) = (7, 0.32, 0.16);
    let start = 18.4;
    for i in 0..steps {
        let z = start + f64::from(i) * run;
        let high = f64::from(i + 1) * rise;
        let back = if i + 1 == steps { LENGTH - 0.001 } else { z + run };
        // Each step reaches down to the floor; its back is hidden by the next.
        shapes.block(m.plaster, dvec3(-2.6, 0.0, z), dvec3(2.6, high, back));
        shapes.block(m.wood, dvec3(-2.0, high, z - 0.02), dvec3(2.0, high + 0.015, z + run - 0.03));
    }
}
