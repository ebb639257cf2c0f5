//! How densely weighted points lie on surfaces: the points around a place that face the same way, in
//! cells of an octree, over the area of a cell's side.

use glam::Vec3;

use crate::cluster::morton;
use crate::render::materials::hit::Facet;

/// Levels of the octree under its root.
const LEVELS: u32 = 19;
/// Bits of a place on the curve, see [`Cells`].
const BITS: u32 = 3 * LEVELS;
/// Ways that surfaces face: along an axis, or against it.
const SIDES: usize = 6;

/// Weighted points on surfaces, by the way that they face and along a Morton curve.
#[derive(Debug)]
pub struct Density {
    extent: Extent,
    /// Sides and places on the curve, in order.
    keys: Vec<u64>,
    /// Sums of the weights before each point, and of all.
    sums: Vec<f64>,
}

/// The cube that the root of the octree is.
#[derive(Debug, Clone, Copy)]
pub struct Extent {
    /// Its lowest corner.
    pub low: Vec3,
    /// The length of its edges.
    pub edge: f32,
}

/// The points of a cell.
#[derive(Debug, Clone, Copy)]
struct Cell {
    first: usize,
    end: usize,
    /// Levels under the root.
    level: u32,
}

impl Cell {
    fn holds(&self, least: usize) -> bool {
        self.end - self.first >= if self.level == 0 { 1 } else { least.max(1) }
    }
}

impl Extent {
    fn of(positions: impl Iterator<Item = Vec3> + Clone) -> Self {
        let low = positions.clone().fold(Vec3::INFINITY, Vec3::min);
        let high = positions.fold(Vec3::NEG_INFINITY, Vec3::max);
        let edge = (high - low).max_element().max(f32::MIN_POSITIVE);
        // A little more on all sides, so that rounding leaves none outside.
        Self { low: low - 1e-3 * edge, edge: 1.002 * edge }
    }

    /// The side and the place on the curve; places outside are moved to the border.
    fn key(&self, Facet { position, normal }: Facet) -> u64 {
        let axis = normal.abs().max_position();
        let side = 2 * axis + usize::from(normal[axis] < 0.0);
        let local = ((position - self.low) / self.edge).clamp(Vec3::ZERO, Vec3::ONE);
        (side as u64) << BITS | morton(4.0 * local - 2.0) >> 6
    }
}

impl Density {
    /// Of positions, unit normals and weights. Sums are in f64 and in the order of the keys, then of
    /// the points.
    pub fn of(points: impl Iterator<Item = (Facet, f64)> + Clone) -> Self {
        let extent = Extent::of(points.clone().map(|(facet, _)| facet.position));
        let mut order: Vec<(u64, f64)> =
            points.map(|(facet, weight)| (extent.key(facet), weight)).collect();
        order.sort_by_key(|&(key, _)| key);
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        sums.extend(order.iter().map(|&(_, weight)| {
            sum += weight;
            sum
        }));
        Self { extent, keys: order.into_iter().map(|(key, _)| key).collect(), sums }
    }

    /// The cube around all points.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// The weight over the area in the smallest cell around a place that holds at least `least`
    /// points.
    pub fn at(&self, place: Facet, least: usize) -> f64 {
        self.around(place, least).last().map_or(0.0, |cell| self.of_cell(cell))
    }

    /// The greatest of all cells around a place that hold at least `least` points.
    pub fn greatest(&self, place: Facet, least: usize) -> f64 {
        self.around(place, least).map(|cell| self.of_cell(cell)).fold(0.0, f64::max)
    }

    fn of_cell(&self, cell: Cell) -> f64 {
        let edge = f64::from(self.extent.edge) / f64::from(1u32 << cell.level);
        (self.sums[cell.end] - self.sums[cell.first]).max(0.0) / (edge * edge)
    }

    /// The cells around a place that hold at least so many points, from the root on, which needs no
    /// more than one.
    fn around(&self, place: Facet, least: usize) -> impl Iterator<Item = Cell> + '_ {
        let key = self.extent.key(place);
        let whole = Cell { first: 0, end: self.keys.len(), level: 0 };
        let root = self.part(whole, key, 0);
        let below = move |cell: &Cell| {
            let level = cell.level + 1;
            (level <= LEVELS).then(|| self.part(*cell, key, level))
        };
        std::iter::successors(Some(root), below).take_while(move |cell| cell.holds(least))
    }

    /// Of the points of a cell those in the cell of a key some levels under the root.
    fn part(&self, cell: Cell, key: u64, level: u32) -> Cell {
        let shift = BITS - 3 * level;
        let keys = &self.keys[cell.first..cell.end];
        let before = keys.partition_point(|&other| other >> shift < key >> shift);
        let within = keys[before..].partition_point(|&other| other >> shift == key >> shift);
        let first = cell.first + before;
        Cell { first, end: first + within, level }
    }

    /// The density everywhere, as [`Density::at`] gives it: the octree cut where cells hold fewer
    /// points; 0 for ways that no point faces.
    pub fn cells(&self, least: usize) -> Cells {
        let mut cells = Cells { extent: self.extent, keys: Vec::new(), values: Vec::new() };
        for side in 0..SIDES as u64 {
            let key = side << BITS;
            let root = self.part(Cell { first: 0, end: self.keys.len(), level: 0 }, key, 0);
            self.cut(root, key, least, 0.0, &mut cells);
        }
        cells
    }

    /// Adds the cells under one that begins with a key; `above` is the density of the one above.
    fn cut(&self, cell: Cell, key: u64, least: usize, above: f64, cells: &mut Cells) {
        if !cell.holds(least) {
            return cells.push(key, above);
        }
        let own = self.of_cell(cell);
        if cell.level == LEVELS {
            return cells.push(key, own);
        }
        for child in 0..8 {
            let key = key | child << (BITS - 3 * (cell.level + 1));
            self.cut(self.part(cell, key, cell.level + 1), key, least, own, cells);
        }
    }
}

/// A number for every place and way that a surface may face there: intervals of the curve. A key has
/// the side in front of 57 bits of the place.
#[derive(Debug, Clone)]
pub struct Cells {
    /// Where the octree is.
    pub extent: Extent,
    /// Where intervals begin; the first is 0.
    pub keys: Vec<u64>,
    /// What they hold.
    pub values: Vec<f64>,
}

impl Cells {
    /// One number everywhere.
    pub fn even(value: f64) -> Self {
        let extent = Extent { low: Vec3::splat(-1.0), edge: 2.0 };
        Self { extent, keys: vec![0], values: vec![value] }
    }

    fn push(&mut self, key: u64, value: f64) {
        if self.values.last() != Some(&value) {
            self.keys.push(key);
            self.values.push(value);
        }
    }

    /// The number at a place.
    pub fn at(&self, place: Facet) -> f64 {
        let key = self.extent.key(place);
        self.values[self.keys.partition_point(|&first| first <= key).max(1) - 1]
    }

    /// The words that the device reads: see `shaders/compensation/bound.wgsl`.
    pub fn words(&self) -> Vec<u32> {
        let Extent { low, edge } = self.extent;
        let mut words = [low.x, low.y, low.z, edge].map(f32::to_bits).to_vec();
        for (key, value) in self.keys.iter().zip(&self.values) {
            let [high, low] = [key >> 30, key & ((1 << 30) - 1)].map(|part| part as u32);
            words.extend([high, low, (*value as f32).to_bits(), self.keys.len() as u32]);
        }
        words
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Sequence;

    fn facet(position: Vec3, normal: Vec3) -> Facet {
        Facet { position, normal }
    }

    fn points(count: u32) -> Vec<(Facet, f64)> {
        let sequence = Sequence::new(5);
        let point = |i| {
            let [x, y, z] = [0, 1, 2].map(|d| sequence.sample(i, d));
            // Twice as dense where x is small; a floor, and every eighth on a wall.
            let x = if x < 0.5 { x } else { 2.0 * x - 0.5 };
            match i % 8 {
                0 => (facet(Vec3::new(0.0, x, y), Vec3::X), 1.0),
                _ => (
                    facet(Vec3::new(x, 0.0, y), Vec3::new(0.1, 0.9, -0.2).normalize()),
                    f64::from(z),
                ),
            }
        };
        (0..count).map(point).collect()
    }

    #[test]
    fn cells_say_what_points_around_say() {
        let points = points(3000);
        let density = Density::of(points.iter().copied());
        for least in [1, 8, 5000] {
            let cells = density.cells(least);
            for &(place, _) in &points {
                let [a, b] = [density.at(place, least), cells.at(place)];
                assert!(a == b, "{place:?}: {a} and {b}");
            }
        }
    }

    #[test]
    fn densities_are_those_of_the_points() {
        let points = points(1 << 16);
        let density = Density::of(points.iter().copied());
        let at = |x| {
            let mean =
                |sum: f64, z| sum + density.at(facet(Vec3::new(x, 0.0, z), Vec3::Y), 256) / 16.0;
            (0..16u8).fold(0.0, |sum, i| mean(sum, (f32::from(i) + 0.5) / 16.0))
        };
        // 7/8 of the points with a mean weight of a half, over an area of 1.5 by 1.
        let [dense, sparse] = [at(0.25), at(1.1)];
        let expected = 65536.0 * 7.0 / 8.0 * 0.5;
        assert!((dense / expected - 1.0).abs() < 0.1, "{dense}, not {expected}");
        assert!((sparse / (0.5 * expected) - 1.0).abs() < 0.1, "{sparse}, not half {expected}");
        assert!(density.greatest(facet(Vec3::new(0.25, 0.0, 0.5), Vec3::Y), 2) >= dense);
        // Nothing faces down.
        assert!(density.at(facet(Vec3::new(0.25, 0.0, 0.5), Vec3::NEG_Y), 1) == 0.0);
    }
}
