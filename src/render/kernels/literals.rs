//! The triangles of a small scene as WGSL: rays are put to each of them, with no hierarchy, no
//! loop and no load.

use std::collections::HashMap;
use std::fmt::{Display, Formatter, Result, Write};
use std::sync::Arc;

use glam::{DVec3, Vec3};

use super::catalogue::{HIT_POINT, LITERAL_SEGMENTS, LITERALS};
use crate::bvh::Bvh;
use crate::gpu::{Module, Program, TriangleRecord};
use crate::scene::Scene;

/// A small scene, written for its kernels.
#[derive(Debug, Clone)]
pub struct Literals {
    /// `meet_scene` of all triangles.
    pub all: Arc<str>,
    /// `meet_scene` of those that may be between two places of the scene.
    pub blockers: Arc<str>,
    /// Whether the blockers are so few that four rays at once suit them.
    pub suit_packets: bool,
}

impl Literals {
    /// Scenes of more triangles have none.
    ///
    /// Cornell box, 512², and the same with small boxes in it; llvmpipe on two cores. Seconds of a
    /// frame of [`Method::Both`](crate::render::Method::Both), and of paths of 4 samples, unlimited:
    /// through the hierarchy, then with literals in all kernels; the first frame with compilation
    /// (no cache of shaders), the others without:
    ///
    /// | triangles | first | | others | | paths, first | | others | |
    /// | --- | --- | --- | --- | --- | --- | --- | --- | --- |
    /// | 38 | 2.99 | 2.55 | 1.57 | 1.15 | 2.61 | 1.24 | 2.08 | 0.76 |
    /// | 62 | 2.98 | 3.17 | 1.61 | 1.36 | 2.67 | 1.52 | 2.25 | 0.84 |
    /// | 98 | 2.78 | 4.04 | 1.67 | 1.65 | 2.76 | 2.26 | 2.30 | 1.27 |
    /// | 158 | 3.04 | 6.57 | 1.94 | 2.52 | 3.61 | 5.08 | 3.21 | 2.86 |
    ///
    /// A loop over all triangles, loaded as in the hierarchy's leaves, is slower than the
    /// hierarchy everywhere: at 38 triangles 2.45 s and, of paths, 2.69 s; at 98 4.4 and 5.7 s.
    const MOST_TRIANGLES: usize = 64;
    /// Of more blockers, what four rays have to do with their edges fits no registers. Seconds of
    /// the visibility stage in the frames above, through the hierarchy and with literals: 0.15 and
    /// 0.08 with 38 triangles, 0.18 and 0.25 with 62, 0.20 and 0.37 with 98.
    /// 119 million rays to 500 VPLs: 2.2 and 1.4 s; with the walls, which block nothing, 3.7 and
    /// 6.8 s on a busy machine. One ray at a time takes as long as the hierarchy.
    const MOST_IN_PACKETS: usize = 32;

    /// Those of a scene, if it is small, of triangles alone, and without holes in them.
    pub fn of(scene: &Scene, bvh: &Bvh) -> Option<Self> {
        let cut = scene.materials.iter().any(|material| material.cutout.is_some());
        if !scene.spheres.is_empty() || cut {
            return None;
        }
        let lights = scene.point_lights.iter().map(|light| light.position);
        // Where rays start and end is on the ray that found the place: at an edge, outside.
        let places: Vec<Vec3> = lights.chain([scene.camera.position]).collect();
        let far = scene.environment.is_some() || !scene.directional_lights.is_empty();
        Self::of_triangles(&bvh.triangles, &places, far)
    }

    /// Those of triangles, if they are few. Shadow rays go between places on them, and others where
    /// lights and the camera are; `far` is whether some go out of the scene.
    pub fn of_triangles(triangles: &[TriangleRecord], others: &[Vec3], far: bool) -> Option<Self> {
        let distinct = by_index(triangles);
        if distinct.len() > Self::MOST_TRIANGLES {
            return None;
        }
        let corners = distinct.iter().flat_map(|(_, record)| corners(record));
        let places: Vec<_> = corners.chain(others.iter().map(|other| other.as_dvec3())).collect();
        let blockers = triangles.iter().filter(|record| far || !bounds(record, &places));
        let blockers: Vec<_> = blockers.copied().collect();
        Some(Self {
            all: meet(triangles).into(),
            blockers: meet(&blockers).into(),
            suit_packets: by_index(&blockers).len() <= Self::MOST_IN_PACKETS,
        })
    }

    /// A program that asks for them, with them: all triangles where it finds what rays hit.
    pub fn complete(&self, program: Program) -> Program {
        let links = |module: &'static Module| program.modules.contains(&module);
        let generated = match links(&LITERALS) || links(&LITERAL_SEGMENTS) {
            true if links(&HIT_POINT) => Some(self.all.clone()),
            true => Some(self.blockers.clone()),
            false => None,
        };
        Program { generated, ..program }
    }
}

/// Writes `meet_scene`, which puts rays to triangles. What an edge, a plane and a triangle are to rays is
/// up to the module that calls it, of `edge`, `plane` and `nearer`.
///
/// Every edge and every plane is there once, however many triangles share it.
pub fn meet(triangles: &[TriangleRecord]) -> String {
    let mut text = Text::default();
    for (at, record) in by_index(triangles) {
        text.triangle(at, corners(record));
    }
    let lines = text.lines;
    format!(
        "fn meet_scene(ray: Ray, limit: f32) -> Met {{\n    var met = none(limit);\n{lines}    return met;\n}}\n"
    )
}

/// Whether all places are on one side of a triangle, or in its plane: it hides none from another.
/// (Two in its plane may be seen from opposite sides of it, but between them passes no light: their
/// cosines are 0.)
fn bounds(record: &TriangleRecord, places: &[DVec3]) -> bool {
    /// What the corners of a quad that is flat in f64 may be off in f32.
    const ROUNDING: f64 = 1e-6;
    let [a, b, c] = corners(record);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let heights = || places.iter().map(|place| (*place - a).dot(normal));
    heights().all(|height| height < ROUNDING) || heights().all(|height| height > -ROUNDING)
}

fn corners(record: &TriangleRecord) -> [DVec3; 3] {
    [record.a, record.b, record.c].map(|corner| Vec3::from_array(corner).as_dvec3())
}

/// Triangles with their places in the order of the leaves, each once, by their indices.
fn by_index(triangles: &[TriangleRecord]) -> Vec<(usize, &TriangleRecord)> {
    let mut sorted: Vec<_> = triangles.iter().enumerate().collect();
    sorted.sort_by_key(|(_, record)| record.index);
    sorted.dedup_by_key(|(_, record)| record.index);
    sorted
}

/// The body of `meet_scene`.
#[derive(Debug, Default)]
struct Text {
    lines: String,
    /// The name of what each expression gives.
    names: HashMap<String, usize>,
}

impl Text {
    fn triangle(&mut self, at: usize, [a, b, c]: [DVec3; 3]) {
        let Some(normal) = (b - a).cross(c - a).try_normalize() else { return };
        let height = normal.dot(a) as f32;
        let plane = self.value(format!("plane(ray, {}, {height:?})", Literal(normal)));
        let [u, v, w] = [(b, c), (c, a), (a, b)].map(|(from, to)| self.edge(from, to));
        // What the rounding of the volumes is relative to where it is beyond the bounds of a scene.
        let farthest = [a, b, c].map(|corner| corner.abs().max_element());
        let farthest = farthest.into_iter().fold(1.0, f64::max) as f32;
        let lengths = Literal(DVec3::new(b.distance(c), c.distance(a), a.distance(b)));
        // Writing to a string does not fail.
        let _ = writeln!(
            self.lines,
            "    met = nearer(met, v{plane}, {u}, {v}, {w}, ray.slack * {farthest:?}, {lengths}, {at}u);"
        );
    }

    /// The volume of an edge over its length, which is the opposite in the other direction.
    fn edge(&mut self, from: DVec3, to: DVec3) -> String {
        let turned = from.to_array() > to.to_array();
        let (low, high) = if turned { (to, from) } else { (from, to) };
        let along = (high - low).normalize();
        let (direction, moment) = (Literal(along), Literal(low.cross(along)));
        let name = self.value(format!("edge(ray, {direction}, {moment})"));
        format!("{}v{name}", if turned { "-" } else { "" })
    }

    /// The number of a value, which is computed where it is first used.
    fn value(&mut self, expression: String) -> usize {
        let next = self.names.len();
        *self.names.entry(expression).or_insert_with_key(|expression| {
            let _ = writeln!(self.lines, "    let v{next} = {expression};");
            next
        })
    }
}

/// A vector as it is written in WGSL.
struct Literal(DVec3);

impl Display for Literal {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        // 0 and -0 are one.
        let [x, y, z] = (self.0.as_vec3() + Vec3::ZERO).to_array();
        write!(f, "vec3f({x:?}, {y:?}, {z:?})")
    }
}
