//! Membership of points in several clusters.

use glam::Vec3;
use rayon::prelude::*;

use super::grid::{Entry, Grid, reach};
use super::points::{CHUNK, Clusters, Points};
use super::scale::Scale;

/// The fuzziness q of the weights w_c = 1 / Σ_k (d_c/d_k)^(2/(q−1)).
const FUZZINESS: f64 = 2.0;

/// For each point, its up to `m` nearest clusters that accept it, nearest first, and their
/// weights by fuzzy C-means (Bezdek 1981), which sum to 1: `m` of both for each point.
///
/// The point's own cluster is always among them, if need be in place of the last. Where
/// there are fewer, the rest is filled with the own cluster at weight 0. A point on a mean
/// belongs to that cluster alone: its own if it is on that, else the first.
pub fn fuzzy(
    points: &Points,
    clustering: &Clusters,
    m: u32,
    normal_threshold: f32,
) -> (Vec<u32>, Vec<f32>) {
    let m = m as usize;
    let length = points.positions.len() * m;
    let (mut clusters, mut weights) = (vec![0; length], vec![0.0; length]);
    if length == 0 {
        return (clusters, weights);
    }
    let scale = Scale::of(points.positions);
    let positions = scale.apply(points.positions);
    let centroids = clustering.clusters.iter();
    let grid = Grid::new(centroids.map(|cluster| (cluster.position * scale.0, cluster.normal)));

    let chunks = clusters.par_chunks_mut(CHUNK * m).zip(weights.par_chunks_mut(CHUNK * m));
    chunks.enumerate().for_each(|(chunk, (clusters, weights))| {
        let mut nearest = Nearest { most: m, found: Vec::with_capacity(m + 1) };
        let mut guess = grid.cell();
        let each = clusters.chunks_exact_mut(m).zip(weights.chunks_exact_mut(m));
        for (at, (clusters, weights)) in each.enumerate() {
            let point = chunk * CHUNK + at;
            let (position, normal) = (positions[point], points.normals[point]);
            guess = nearest.search(&grid, position, normal, normal_threshold, guess);
            let own = clustering.assignment[point];
            nearest.include(&grid, own, position);
            clusters.fill(own);
            weigh(&mut nearest.found, own, clusters, weights);
        }
    });
    (clusters, weights)
}

/// The nearest clusters of a point, as square of the distance and index, in this order.
struct Nearest {
    most: usize,
    found: Vec<(f32, u32)>,
}

impl Nearest {
    /// Finds them, and returns within which radius they are, a guess for the next point.
    fn search(
        &mut self,
        grid: &Grid,
        position: Vec3,
        normal: Vec3,
        threshold: f32,
        guess: f32,
    ) -> f32 {
        let mut radius = guess.min(4.0 * grid.cell()).max(grid.cell());
        loop {
            self.found.clear();
            let all = grid.visit(position, radius, |entry| {
                if entry.accepts(normal, threshold) {
                    self.insert(entry, position);
                }
            });
            let farthest = match self.found.last() {
                Some(&(distance, _)) if self.found.len() == self.most => reach(distance),
                _ => f32::INFINITY,
            };
            if all || farthest <= radius {
                return farthest.min(radius);
            }
            radius = farthest.min(2.0 * radius);
        }
    }

    fn insert(&mut self, entry: &Entry, position: Vec3) {
        let new = (entry.distance(position), entry.index);
        if self.found.len() == self.most {
            if self.found.last().is_none_or(|&last| last < new) {
                return;
            }
            self.found.pop();
        }
        let place = self.found.iter().rposition(|&other| other < new).map_or(0, |last| last + 1);
        self.found.insert(place, new);
    }

    /// Puts a cluster among them that is not, in place of the last if they are complete.
    fn include(&mut self, grid: &Grid, own: u32, position: Vec3) {
        if self.found.iter().any(|&(_, cluster)| cluster == own) {
            return;
        }
        if let Some(entry) = grid.entry(own) {
            self.found.truncate(self.most - 1);
            self.insert(entry, position);
        }
    }
}

/// Writes the clusters and their weights, all of which are 0 before.
fn weigh(found: &mut Vec<(f32, u32)>, own: u32, clusters: &mut [u32], weights: &mut [f32]) {
    // The own cluster is the first of all on which the point is.
    let on = |&(distance, _): &(f32, u32)| distance == 0.0;
    let owned = found.iter().copied().find(|nearest| on(nearest) && nearest.1 == own);
    if let Some(alone) = owned.or(found.first().copied().filter(on)) {
        found.clear();
        found.push(alone);
    }
    // With 1 for the nearest no weight is infinite before they are normalised.
    let share = |distance: f32| {
        let ratio = f64::from(found[0].0) / f64::from(distance);
        if found.len() == 1 { 1.0 } else { ratio.powf(1.0 / (FUZZINESS - 1.0)) }
    };
    let sum: f64 = found.iter().map(|&(distance, _)| share(distance)).sum();
    for (at, &(distance, cluster)) in found.iter().enumerate() {
        clusters[at] = cluster;
        weights[at] = (share(distance) / sum) as f32;
    }
}
