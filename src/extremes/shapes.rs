//! Meshes of many triangles, made as OBJ text.

use std::f64::consts::{PI, TAU};
use std::fmt::{Display, Write};

/// The OBJ text of a shape: its name and its numbers.
///
/// - `sphere SEGMENTS RINGS`: the unit sphere, its front outside;
/// - `ball SEGMENTS RINGS X Y Z R`: the same about another centre, of another radius;
/// - `grid N`: the square [-1, 1]² at z = 0 in N² cells, its front above;
/// - `room N`: the cube [-1, 1]³ in 6 N² cells, its front inside;
/// - `slivers N WIDTH`: the same square as `grid`, with N strips of that width in its middle;
/// - `star N`: a star of N rays in one concave polygon, radii 1 and 0.3, at z = 0;
/// - `fan N`: the same star in triangles about its middle.
///
/// # Errors
/// There is no such shape.
pub fn obj(description: &str) -> Result<String, String> {
    let words: Vec<&str> = description.split_whitespace().collect();
    let number = |text: &str| text.parse::<u32>().ok().filter(|n| *n > 0);
    let made = match words[..] {
        ["sphere", segments, rings] => {
            number(segments).zip(number(rings)).map(|(segments, rings)| sphere(segments, rings))
        }
        ["ball", segments, rings, x, y, z, radius] => {
            let place = [x, y, z, radius].map(|text| text.parse::<f64>().ok());
            let ball = |(segments, rings)| match place {
                [Some(x), Some(y), Some(z), Some(radius)] => {
                    Some(ball(segments, rings, [x, y, z], radius))
                }
                _ => None,
            };
            number(segments).zip(number(rings)).and_then(ball)
        }
        ["grid", n] => number(n).map(grid),
        ["room", n] => number(n).map(room),
        ["slivers", n, width] => {
            number(n).zip(width.parse().ok()).map(|(n, width)| slivers(n, width))
        }
        ["star", n] => number(n).map(star),
        ["fan", n] => number(n).map(fan),
        _ => None,
    };
    made.map(|obj| obj.0).ok_or_else(|| format!("`{description}` is no shape"))
}

/// OBJ text in the making.
#[derive(Default)]
struct Obj(String);

impl Obj {
    fn line(&mut self, line: impl Display) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{line}");
    }

    fn vertex(&mut self, [x, y, z]: [f64; 3]) {
        self.line(format_args!("v {x} {y} {z}"));
    }

    /// Quads between the vertices of a lattice, `columns` to a row, row by row from `first`.
    fn cells(&mut self, first: u32, columns: u32, rows: u32) {
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let a = first + row * columns + column;
                self.line(format_args!("f {a} {} {} {}", a + 1, a + 1 + columns, a + columns));
            }
        }
    }
}

fn sphere(segments: u32, rings: u32) -> Obj {
    ball(segments, rings, [0.0; 3], 1.0)
}

fn ball(segments: u32, rings: u32, center: [f64; 3], size: f64) -> Obj {
    let mut obj = Obj::default();
    let at = |segment: u32, ring: u32| {
        let (around, down) = (TAU * f64::from(segment % segments), PI * f64::from(ring));
        let (around, down) = (around / f64::from(segments), down / f64::from(rings));
        let radius = if ring == rings { 0.0 } else { down.sin() };
        let place = [radius * around.cos(), radius * around.sin(), down.cos()];
        [0, 1, 2].map(|axis| center[axis] + size * place[axis])
    };
    // Both poles and the seam have a vertex for each segment; the cells there lose a triangle.
    for ring in 0..=rings {
        (0..=segments).for_each(|segment| obj.vertex(at(segment, rings - ring)));
    }
    obj.cells(1, segments + 1, rings + 1);
    obj
}

/// From -1 to 1 in so many steps.
fn step(i: u32, n: u32) -> f64 {
    2.0 * f64::from(i) / f64::from(n) - 1.0
}

fn grid(n: u32) -> Obj {
    let mut obj = Obj::default();
    for j in 0..=n {
        (0..=n).for_each(|i| obj.vertex([step(i, n), step(j, n), 0.0]));
    }
    obj.cells(1, n + 1, n + 1);
    obj
}

fn room(n: u32) -> Obj {
    let mut obj = Obj::default();
    let mut first = 1;
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            for j in 0..=n {
                for i in 0..=n {
                    // Seen from inside, a wall's first direction turns left into its second.
                    let u = -side * step(i, n);
                    let mut point = [0.0; 3];
                    point[axis] = side;
                    point[(axis + 1) % 3] = u;
                    point[(axis + 2) % 3] = step(j, n);
                    obj.vertex(point);
                }
            }
            obj.cells(first, n + 1, n + 1);
            first += (n + 1) * (n + 1);
        }
    }
    obj
}

fn slivers(n: u32, width: f64) -> Obj {
    let mut obj = Obj::default();
    let start = -0.5 * f64::from(n) * width;
    let mut edges = vec![-1.0];
    edges.extend((0..=n).map(|i| start + f64::from(i) * width));
    edges.push(1.0);
    for y in [-1.0, 1.0] {
        edges.iter().for_each(|&x| obj.vertex([x, y, 0.0]));
    }
    obj.cells(1, n + 3, 2);
    obj
}

/// The corners of a star.
fn rays(n: u32) -> Obj {
    let mut obj = Obj::default();
    for i in 0..2 * n {
        let (angle, radius) = (PI * f64::from(i) / f64::from(n), [1.0, 0.3][i as usize % 2]);
        obj.vertex([radius * angle.cos(), radius * angle.sin(), 0.0]);
    }
    obj
}

fn star(n: u32) -> Obj {
    let mut obj = rays(n);
    let corners: Vec<_> = (1..=2 * n).map(|i| i.to_string()).collect();
    obj.line(format_args!("f {}", corners.join(" ")));
    obj
}

fn fan(n: u32) -> Obj {
    let mut obj = rays(n);
    obj.vertex([0.0; 3]);
    for i in 1..=2 * n {
        obj.line(format_args!("f {} {i} {}", 2 * n + 1, i % (2 * n) + 1));
    }
    obj
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_have_their_vertices_and_faces() {
        let count = |description: &str| {
            let text = obj(description).unwrap();
            let lines = |start| text.lines().filter(|line| line.starts_with(start)).count();
            (lines("v "), lines("f "))
        };
        assert_eq!((count("sphere 8 4"), count("ball 8 4 1 2 3 0.5")), ((45, 32), (45, 32)));
        assert_eq!(count("grid 3"), (16, 9));
        assert_eq!(count("room 2"), (54, 24));
        assert_eq!(count("slivers 5 1e-6"), (16, 7));
        assert_eq!((count("star 5"), count("fan 5")), ((10, 1), (11, 10)));
        assert!(
            ["", "grid", "grid 0", "cube 3", "grid x", "ball 8 4 1 2 3 r"]
                .iter()
                .all(|text| obj(text).is_err())
        );
    }
}
