//! K-means of points with normals, gated by their directions: clusters of visible points,
//! where visibility is then computed, and of virtual point lights.
//!
//! The distance of a point p to a centroid c is |p − c| where n_p · n_c is above a threshold,
//! and infinite elsewhere. Each iteration assigns every point to its nearest centroid and
//! moves the centroids to the means of their members (Lloyd 1982). The nearest centroid is
//! found exactly, in a [`Grid`]; ties go to the lowest index.
//!
//! - A point that no centroid accepts is never dropped, it founds a cluster: in the order of
//!   the points, each that no founder of this iteration accepts yet becomes one, and then
//!   all such points go to their nearest founder. So there may be more clusters than asked.
//! - An empty cluster is reseeded from the point farthest from its centroid before another
//!   iteration (unless that saw a part of the points only), and left out of the result. So
//!   there may be fewer.
//! - Where there are no more distinct points than clusters asked for, each is a cluster; so
//!   it is where the threshold is 1, which no centroid passes.
//!
//! Nothing depends on the number of threads: points are searched independently, and the sums
//! of a cluster are taken over its members in their order, in f64.

mod fuzzy;
mod grid;
mod members;
mod start;

use glam::Vec3;
use rayon::prelude::*;

pub use fuzzy::fuzzy;
pub use grid::Grid;
use members::{Centroid, Members};

/// Stands for "no cluster" in an assignment that is not finished.
const NONE: u32 = u32::MAX;
/// So many points are searched by one thread at a time.
const CHUNK: usize = 2048;

/// Points with facing unit normals, as many of these as of those; all finite.
#[derive(Debug, Clone, Copy)]
pub struct Points<'a> {
    /// Where the points are, in any unit.
    pub positions: &'a [Vec3],
    /// Their unit normals.
    pub normals: &'a [Vec3],
}

/// What is asked of [`kmeans`].
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

/// A cluster of points; all of it is of its final members.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cluster {
    /// The mean of the members' positions.
    pub position: Vec3,
    /// The mean of their normals, renormalised; that of the representative if they cancel.
    pub normal: Vec3,
    /// The member nearest to the mean; of several, the one of lowest index.
    pub representative: u32,
    /// How many points it has; at least 1.
    pub members: u32,
}

/// Points in clusters.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Clustering {
    /// The clusters, none of them empty.
    pub clusters: Vec<Cluster>,
    /// The index of its cluster, for each point.
    pub assignment: Vec<u32>,
    /// Iterations done; 0 if every distinct point is a cluster.
    pub iterations: u32,
}

/// Clusters points by position and normal.
pub fn kmeans(points: &Points, options: &Options) -> Clustering {
    if points.positions.is_empty() {
        return Clustering::default();
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
) -> Clustering {
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
    Clustering { clusters, assignment, iterations }
}

/// The clusters of the points that an iteration has seen, which are one in `stride`.
struct Seen {
    stride: usize,
    assignment: Vec<u32>,
}

impl Seen {
    /// The nearest accepted centroid of each point, or [`NONE`]. Two good guesses make the
    /// search short: the cluster that a point, or its neighbour, had before, and that of the
    /// last point. They do not change what is found.
    fn assign(points: &Points, grid: &Grid, threshold: f32, stride: usize, before: &Seen) -> Self {
        let mut assignment = vec![NONE; points.positions.len().div_ceil(stride)];
        let chunks = assignment.par_chunks_mut(CHUNK).enumerate();
        chunks.for_each(|(chunk, assignment)| {
            let mut last = NONE;
            for (at, cluster) in assignment.iter_mut().enumerate() {
                let point = (chunk * CHUNK + at) * stride;
                let known = before.assignment.get(point / before.stride);
                let guesses = [known.copied().unwrap_or(NONE), last];
                let (position, normal) = (points.positions[point], points.normals[point]);
                if let Some(found) = grid.nearest(position, normal, threshold, guesses) {
                    *cluster = found.0;
                    last = found.0;
                }
            }
        });
        Self { stride, assignment }
    }
}

/// A power of two that brings coordinates to where their squares neither overflow nor
/// vanish; 1 for all but extraordinary ones.
#[derive(Debug, Clone, Copy)]
struct Scale(f32);

impl Scale {
    fn of(positions: &[Vec3]) -> Self {
        let largest = positions.iter().map(|position| position.abs().max_element());
        let largest = largest.fold(0.0f32, f32::max);
        match largest {
            0.0 | 1e-6..1e9 => Self(1.0),
            _ => Self((-largest.log2().clamp(-126.0, 126.0).round()).exp2()),
        }
    }

    fn apply(self, positions: &[Vec3]) -> std::borrow::Cow<'_, [Vec3]> {
        match self.0 {
            1.0 => positions.into(),
            scale => positions.iter().map(|&position| position * scale).collect(),
        }
    }
}
