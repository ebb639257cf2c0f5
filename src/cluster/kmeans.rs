//! The iterations of K-means.

use rayon::prelude::*;

use super::assignment::Seen;
use super::members::Members;
use super::scale::Scale;
use super::{Cluster, Clusters, Grid, Points, start};

/// What is asked of [`kmeans()`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Clusters to start from; at least 1.
    pub clusters: u32,
    /// At most so many iterations, and at least one; they stop when nothing moves.
    pub iterations: u32,
    /// A centroid accepts a point if the cosine between their normals is above this.
    pub normal_threshold: f32,
    /// All iterations but the last see only one point in so many; at least 1.
    pub stride: u32,
    /// Picks the points that the centroids start from.
    pub seed: u32,
}

/// Clusters points by position and normal.
pub fn kmeans(points: &Points, options: &Options) -> Clusters {
    if points.positions.is_empty() {
        return Clusters::default();
    }
    // A gate that no two directions pass leaves every point alone, as do enough clusters.
    let threshold = options.normal_threshold;
    let clusters = if threshold < 1.0 { options.clusters.max(1) as usize } else { usize::MAX };
    if let Some(identity) = start::distinct(points, clusters) {
        return identity;
    }
    let scale = Scale::of(points.positions);
    let scaled = scale.apply(points.positions);
    let points = &Points { positions: &scaled, normals: points.normals };

    let mut centroids = start::stratified(points, clusters, options.seed);
    let mut before = Seen { stride: 1, assignment: Vec::new() };
    let mut last = options.iterations.max(1);
    let mut iteration = 1;
    loop {
        let stride = if iteration == last { 1 } else { options.stride.max(1) as usize };
        let grid = Grid::new(centroids.iter().copied());
        let mut seen = Seen::assign(points, &grid, threshold, stride, &before);
        let founded = start::found(points, threshold, &mut seen, &mut centroids);
        let members = Members::new(&seen, centroids.len());
        if iteration == last {
            return finish(points, seen.assignment, &members, scale, iteration);
        }
        let moved = members.update(points, &seen, &mut centroids);
        if !(moved || founded) {
            if stride == 1 {
                return finish(points, seen.assignment, &members, scale, iteration);
            }
            last = iteration + 1;
        }
        before = seen;
        iteration += 1;
    }
}

/// The clusters of the last assignment, without those that are empty.
fn finish(
    points: &Points,
    mut assignment: Vec<u32>,
    members: &Members,
    scale: Scale,
    iterations: u32,
) -> Clusters {
    let all: Vec<_> = (0..members.clusters())
        .into_par_iter()
        .with_min_len(16)
        .map(|index| members.cluster(points, index))
        .collect();
    let mut names = Vec::with_capacity(all.len());
    let mut clusters: Vec<Cluster> = Vec::with_capacity(all.len());
    for cluster in all {
        names.push(clusters.len() as u32);
        clusters.extend(cluster);
    }
    for cluster in &mut clusters {
        cluster.position /= scale.0;
    }
    if clusters.len() < names.len() {
        assignment.par_iter_mut().for_each(|index| *index = names[*index as usize]);
    }
    Clusters { clusters, assignment, iterations }
}
