//! A uniform grid over centroids, in which the nearest that accepts a point is found exactly.

use glam::Vec3;

use super::points::{Centroid, NONE};

/// Centroids sorted into the cells of a uniform grid.
///
/// The cell of a coordinate is a monotone function of it, rounding and all, and clamped to
/// the grid. So whatever lies within r of p is in the cells from that of p − r to that of
/// p + r, also where the grid does not cover it: the search needs no other bound, and the
/// grid may leave out the few centroids that are far from all others.
#[derive(Debug, Clone)]
pub struct Grid {
    low: Vec3,
    cells_per_length: f32,
    cell: f32,
    size: [usize; 3],
    /// Where the entries of each cell start, and one more.
    starts: Vec<u32>,
    entries: Vec<Entry>,
    /// Where the entry of each centroid is.
    places: Vec<u32>,
}

/// A centroid in its cell.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Entry {
    pub position: Vec3,
    pub index: u32,
    pub normal: Vec3,
}

impl Entry {
    /// The square of the distance.
    pub fn distance(&self, position: Vec3) -> f32 {
        self.position.distance_squared(position)
    }

    pub fn accepts(&self, normal: Vec3, threshold: f32) -> bool {
        normal.dot(self.normal) > threshold
    }
}

impl Grid {
    /// Sorts centroids, given as position and normal.
    pub fn new(centroids: impl ExactSizeIterator<Item = Centroid> + Clone) -> Self {
        let count = centroids.len();
        let (low, extent) = bounds(centroids.clone().map(|(position, _)| position));
        let cell = cell_size(extent, count);
        let cells_per_length =
            Some(cell.recip()).filter(|inverse| inverse.is_finite()).unwrap_or(0.0);
        let size = extent.to_array().map(|length| (length * cells_per_length) as usize + 1);
        let mut grid = Self {
            low,
            cells_per_length,
            cell,
            size,
            starts: vec![0; size[0] * size[1] * size[2] + 1],
            entries: vec![Entry::default(); count],
            places: vec![0; count],
        };

        let cells: Vec<_> = centroids.clone().map(|(position, _)| grid.cell_of(position)).collect();
        for &cell in &cells {
            grid.starts[cell + 1] += 1;
        }
        for cell in 1..grid.starts.len() {
            grid.starts[cell] += grid.starts[cell - 1];
        }
        let mut next = grid.starts.clone();
        for (index, ((position, normal), cell)) in centroids.zip(cells).enumerate() {
            let place = next[cell];
            next[cell] += 1;
            grid.places[index] = place;
            grid.entries[place as usize] = Entry { position, index: index as u32, normal };
        }
        grid
    }

    /// The nearest centroid whose normal has a cosine above the threshold with the given
    /// one, and the square of its distance; of several, that of lowest index. Guesses make
    /// it faster when they are near; those that are no centroid's index are ignored.
    pub fn nearest(
        &self,
        position: Vec3,
        normal: Vec3,
        threshold: f32,
        guesses: [u32; 2],
    ) -> Option<(u32, f32)> {
        let mut best = (NONE, f32::INFINITY);
        let consider = |best: &mut (u32, f32), entry: &Entry| {
            let distance = entry.distance(position);
            if distance <= best.1
                && entry.accepts(normal, threshold)
                && (distance < best.1 || entry.index < best.0)
            {
                *best = (entry.index, distance);
            }
        };
        for guess in guesses {
            if let Some(entry) = self.entry(guess) {
                consider(&mut best, entry);
            }
        }
        // A guess may be far off, as where points come in no order: rings grow up to it.
        let mut radius = reach(0.0).max(self.cell);
        loop {
            radius = radius.min(reach(best.1));
            let all = self.visit(position, radius, |entry| consider(&mut best, entry));
            if all || reach(best.1) <= radius {
                return (best.0 != NONE).then_some(best);
            }
            radius *= 2.0;
        }
    }

    /// The centroid of an index, if there is one.
    pub(super) fn entry(&self, index: u32) -> Option<&Entry> {
        self.places.get(index as usize).map(|&place| &self.entries[place as usize])
    }

    /// The length of a cell's side; 0 if there is one cell only.
    pub(super) fn cell(&self) -> f32 {
        self.cell
    }

    /// Visits all centroids within a distance, and some others. True if these are all.
    pub(super) fn visit(&self, position: Vec3, radius: f32, mut f: impl FnMut(&Entry)) -> bool {
        let low = self.coordinates(position - radius);
        let high = self.coordinates(position + radius);
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                let row = (z * self.size[1] + y) * self.size[0];
                let from = self.starts[row + low[0]] as usize;
                let to = self.starts[row + high[0] + 1] as usize;
                self.entries[from..to].iter().for_each(&mut f);
            }
        }
        (0..3).all(|axis| low[axis] == 0 && high[axis] + 1 == self.size[axis])
    }

    fn coordinates(&self, position: Vec3) -> [usize; 3] {
        let cells = ((position - self.low) * self.cells_per_length).to_array();
        [0, 1, 2].map(|axis| (cells[axis] as i32).clamp(0, self.size[axis] as i32 - 1) as usize)
    }

    fn cell_of(&self, position: Vec3) -> usize {
        let [x, y, z] = self.coordinates(position);
        (z * self.size[1] + y) * self.size[0] + x
    }
}

/// A length that no two points are apart whose distance squared, in f32, is at most this.
pub(super) fn reach(distance_squared: f32) -> f32 {
    distance_squared.sqrt() * (1.0 + 1e-6) + 1e-18
}

/// A box around all but a few of the positions: where the outermost are far outside, their
/// share of its length is no larger than of the count.
fn bounds(positions: impl ExactSizeIterator<Item = Vec3> + Clone) -> (Vec3, Vec3) {
    let count = positions.len();
    if count == 0 {
        return (Vec3::ZERO, Vec3::ZERO);
    }
    let outer = count / 32;
    let [mut low, mut extent] = [[0.0; 3]; 2];
    for axis in 0..3 {
        let mut along: Vec<f32> = positions.clone().map(|position| position[axis]).collect();
        let ends = [0, outer, count - 1 - outer, count - 1]
            .map(|rank| *along.select_nth_unstable_by(rank, f32::total_cmp).1);
        let margin = (ends[2] - ends[1]) / 8.0;
        low[axis] = ends[0].max(ends[1] - margin);
        extent[axis] = ends[3].min(ends[2] + margin) - low[axis];
    }
    (low.into(), extent.into())
}

/// Centroids lie on surfaces: about one for each cell that the box's own surface touches.
/// There are never many more cells than centroids.
fn cell_size(extent: Vec3, count: usize) -> f32 {
    let [x, y, z] = extent.to_array();
    let count = count.max(1) as f32;
    let surface = (2.0 * (x * y + y * z + z * x) / count).sqrt();
    let volume = (x * y * z / (8.0 * count)).cbrt();
    surface.max(volume).max(extent.max_element() / count)
}
