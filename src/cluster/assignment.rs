//! The nearest centroid of each point.

use rayon::prelude::*;

use super::Grid;
use super::points::{CHUNK, NONE, Points};

/// The clusters of the points that an iteration has seen, which are one in `stride`.
pub struct Seen {
    pub stride: usize,
    pub assignment: Vec<u32>,
}

impl Seen {
    /// The nearest accepted centroid of each point, or [`NONE`]. Two good guesses make the
    /// search short: the cluster that a point, or its neighbour, had before, and that of the
    /// last point. They do not change what is found.
    pub fn assign(
        points: &Points,
        grid: &Grid,
        threshold: f32,
        stride: usize,
        before: &Seen,
    ) -> Self {
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
