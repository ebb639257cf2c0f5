//! Surfaces of different materials in one plane, as decals on walls: which of two is met first would be
//! decided by rounding. One of them is put in front of the other, on both sides: that whose material
//! has the smaller area in the plane.
//!
//! Faces that look at each other are most often where one body stands on another: nobody sees them, and
//! they stay. Only a sheet that ends in the plane, as no face of a body does, is put in front of what
//! looks the other way.

mod overlap;

use std::collections::{BTreeMap, BTreeSet, HashMap};

use glam::{DVec3, Vec2, Vec3};

use super::{Material, Triangle};
use crate::sampling::SURFACE_OFFSET;
use overlap::overlap;

/// Planes nearer than this are one: rays start as far from a surface.
const NEAR: f64 = SURFACE_OFFSET as f64;

/// How far one layer is put in front of the next.
const LIFT: f32 = 4.0 * SURFACE_OFFSET;

/// Layers beyond are put in the place of the last.
const MOST_LAYERS: usize = 8;

/// Pairs that are looked at: no file may make us look for hours.
const MOST_LOOKS: usize = 20_000_000;

/// Cells of normals and of distances by which planes are found. Planes that are one but for rounding may
/// lie on either side of a border; of two grids, one does not part them.
const GRIDS: [[f64; 2]; 2] = [[64.0, 1021.0], [79.3, 1303.7]];

/// Triangles, and what belongs to each.
#[derive(Debug, Default)]
pub struct Shapes {
    pub triangles: Vec<Triangle>,
    pub uvs: Vec<[Vec2; 3]>,
    pub colors: Vec<[Vec3; 3]>,
}

/// The plane of a triangle: its unit normal, to one side of all space, and the distance along it.
#[derive(Debug, Clone, Copy)]
struct Plane {
    normal: DVec3,
    distance: f64,
    area: f64,
}

impl Plane {
    fn of(triangle: &Triangle) -> Self {
        let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
        let scaled = (b - a).cross(c - a);
        // No plane that people build is along this.
        let side = scaled.dot(DVec3::new(0.830_117, 0.412_951, 0.374_653)).signum();
        let normal = side * scaled.normalize_or_zero();
        Self { normal, distance: normal.dot((a + b + c) / 3.0), area: 0.5 * scaled.length() }
    }

    fn cell(&self, [normals, distances]: [f64; 2]) -> [i64; 4] {
        let DVec3 { x, y, z } = self.normal * normals;
        [x, y, z, self.distance * distances].map(|value| value.round() as i64)
    }

    fn holds(&self, triangle: &Triangle) -> bool {
        let off = |v: &Vec3| (self.normal.dot(v.as_dvec3()) - self.distance).abs();
        triangle.vertices.iter().all(|vertex| off(vertex) <= NEAR)
    }
}

impl Shapes {
    /// Puts triangles in front of others of their plane, and returns how many pairs there were.
    pub fn part(&mut self, materials: &[Material]) -> usize {
        let first = self.triangles.first().map(|triangle| triangle.material);
        if self.triangles.iter().all(|triangle| Some(triangle.material) == first) {
            return 0;
        }
        let planes: Vec<Plane> = self.triangles.iter().map(Plane::of).collect();
        let mut pairs = BTreeSet::new();
        let mut looks = 0;
        for grid in GRIDS {
            for group in self.groups(&planes, grid) {
                self.overlaps(&planes, &group, &mut looks, &mut pairs);
            }
        }
        let mut pairs = self.ordered(&planes, &pairs);
        let normal = |index: usize| self.triangles[index].scaled_normal();
        let faces = |&(behind, front): &(usize, usize)| normal(behind).dot(normal(front)) > 0.0;
        let opposite: BTreeSet<usize> =
            pairs.iter().filter(|pair| !faces(pair)).map(|&(_, front)| front).collect();
        let open = self.open(&opposite);
        pairs.retain(|pair| faces(pair) || open.contains(&pair.1));
        for (index, layer) in layers(&pairs) {
            self.lift(index, layer, materials);
        }
        pairs.len()
    }

    /// Triangles of each cell that holds more than one material, from left to right.
    fn groups(&self, planes: &[Plane], grid: [f64; 2]) -> Vec<Vec<usize>> {
        let mut keyed: Vec<([i64; 4], usize)> =
            planes.iter().enumerate().map(|(index, plane)| (plane.cell(grid), index)).collect();
        keyed.sort_unstable();
        let material = |index: usize| self.triangles[index].material;
        let several = |group: &&[([i64; 4], usize)]| {
            group.iter().any(|&(_, index)| material(index) != material(group[0].1))
        };
        let left = |index: &usize| extent(&self.triangles[*index])[0].x;
        keyed
            .chunk_by(|one, two| one.0 == two.0)
            .filter(several)
            .map(|group| {
                let mut group: Vec<usize> = group.iter().map(|&(_, index)| index).collect();
                group.sort_by(|one, two| left(one).total_cmp(&left(two)).then(one.cmp(two)));
                group
            })
            .collect()
    }

    /// Adds the pairs of a group that overlap in one plane.
    fn overlaps(
        &self,
        planes: &[Plane],
        group: &[usize],
        looks: &mut usize,
        pairs: &mut BTreeSet<(usize, usize)>,
    ) {
        for (at, &one) in group.iter().enumerate() {
            let [low, high] = extent(&self.triangles[one]);
            for &two in &group[at + 1..] {
                let [other_low, other_high] = extent(&self.triangles[two]);
                if other_low.x > high.x || *looks >= MOST_LOOKS {
                    break;
                }
                *looks += 1;
                let apart = other_low.cmpgt(high).any() || low.cmpgt(other_high).any();
                let (a, b) = (&self.triangles[one], &self.triangles[two]);
                let together = || planes[one].holds(b) && planes[two].holds(a);
                if a.material != b.material
                    && !apart
                    && together()
                    && overlap(a, b, planes[one].normal)
                {
                    pairs.insert((one.min(two), one.max(two)));
                }
            }
        }
    }

    /// The pairs, each as what is behind and what is in front; from the large to the small, so that what
    /// is in front of something is in front of what that covers.
    fn ordered(&self, planes: &[Plane], pairs: &BTreeSet<(usize, usize)>) -> Vec<(usize, usize)> {
        // What a material has of a plane, known by its coarse cell.
        let key = |index: usize| (planes[index].cell(GRIDS[0]), self.triangles[index].material);
        let involved: BTreeSet<_> = pairs.iter().flat_map(|&(a, b)| [key(a), key(b)]).collect();
        let mut areas = BTreeMap::<([i64; 4], u32), f64>::new();
        for index in (0..planes.len()).filter(|&index| involved.contains(&key(index))) {
            *areas.entry(key(index)).or_default() += planes[index].area;
        }
        let area = |index: usize| areas[&key(index)];
        let behind_first = |&(one, two): &(usize, usize)| {
            let behind = area(one).total_cmp(&area(two)).then(two.cmp(&one)).is_ge();
            if behind { (one, two) } else { (two, one) }
        };
        let mut ordered: Vec<(usize, usize)> = pairs.iter().map(behind_first).collect();
        ordered.sort_by(|one, two| area(two.0).total_cmp(&area(one.0)).then(one.cmp(two)));
        ordered
    }

    /// Those of some triangles that are part of a sheet that ends among them: an edge of it is no other
    /// triangle's.
    fn open(&self, of: &BTreeSet<usize>) -> BTreeSet<usize> {
        let mut sharing: HashMap<Edge, Vec<usize>> = of
            .iter()
            .flat_map(|&index| edges(&self.triangles[index]))
            .map(|e| (e, vec![]))
            .collect();
        if sharing.is_empty() {
            return BTreeSet::new();
        }
        for (index, triangle) in self.triangles.iter().enumerate() {
            for edge in edges(triangle) {
                if let Some(all) = sharing.get_mut(&edge) {
                    all.push(index);
                }
            }
        }
        let ends = |index: &usize| {
            edges(&self.triangles[*index]).iter().any(|edge| sharing[edge].len() == 1)
        };
        let mut open: BTreeSet<usize> = of.iter().copied().filter(ends).collect();
        let mut waiting: Vec<usize> = open.iter().copied().collect();
        while let Some(index) = waiting.pop() {
            let around = edges(&self.triangles[index]).into_iter().flat_map(|edge| &sharing[&edge]);
            for &neighbour in around {
                let same = self.triangles[neighbour].material == self.triangles[index].material;
                if same && of.contains(&neighbour) && open.insert(neighbour) {
                    waiting.push(neighbour);
                }
            }
        }
        open
    }

    /// Puts a triangle in front of its plane; one that shines to its front, there alone, any other on
    /// both sides.
    fn lift(&mut self, index: usize, layer: usize, materials: &[Material]) {
        let triangle = self.triangles[index];
        let up = layer as f32 * LIFT * triangle.scaled_normal().normalize_or_zero();
        self.triangles[index].vertices = triangle.vertices.map(|vertex| vertex + up);
        if !materials[triangle.material as usize].emits() {
            let vertices = triangle.vertices.map(|vertex| vertex - up);
            self.triangles.push(Triangle { vertices, ..triangle });
            self.uvs.push(self.uvs[index]);
            self.colors.push(self.colors[index]);
        }
    }
}

/// The triangles to be put in front of others, and the layer of each, from 1 on.
fn layers(pairs: &[(usize, usize)]) -> BTreeMap<usize, usize> {
    let mut layers = BTreeMap::new();
    for (behind, front) in pairs {
        let layer = layers.get(behind).copied().unwrap_or(0) + 1;
        let known = layers.entry(*front).or_insert(0);
        *known = layer.max(*known).min(MOST_LAYERS);
    }
    layers
}

/// The ends of an edge, by their bits, the lesser first.
type Edge = [[u32; 3]; 2];

fn edges(triangle: &Triangle) -> [Edge; 3] {
    let [a, b, c] = triangle.vertices.map(|vertex| vertex.to_array().map(f32::to_bits));
    [[a, b], [b, c], [c, a]].map(|mut edge| {
        edge.sort_unstable();
        edge
    })
}

/// Opposite corners of the bounds of a triangle, widened by what is no distance.
fn extent(triangle: &Triangle) -> [Vec3; 2] {
    let [a, b, c] = triangle.vertices;
    [a.min(b).min(c) - SURFACE_OFFSET, a.max(b).max(c) + SURFACE_OFFSET]
}

#[cfg(test)]
mod tests;
