//! Where clusters come from: a spread of points to start with, points that no centroid
//! accepts, or every distinct point.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::Grid;
use super::assignment::Seen;
use super::points::{Centroid, Cluster, Clusters, NONE, Points};

/// Every distinct point as a cluster, in the order in which they first come, unless there
/// are more than so many.
pub(super) fn distinct(points: &Points, most: usize) -> Option<Clusters> {
    let mut names = HashMap::with_capacity(most.min(points.positions.len()));
    let mut all = Clusters::default();
    for (index, (&position, &normal)) in points.positions.iter().zip(points.normals).enumerate() {
        // Adding 0 makes −0 the same as 0.
        let key = [position.to_array(), normal.to_array()].map(|v| v.map(|x| (x + 0.0).to_bits()));
        let name = match names.entry(key) {
            Entry::Occupied(name) => *name.get(),
            Entry::Vacant(_) if all.clusters.len() == most => return None,
            Entry::Vacant(vacant) => {
                let representative = index as u32;
                all.clusters.push(Cluster { position, normal, representative, members: 0 });
                *vacant.insert(all.clusters.len() - 1)
            }
        };
        all.clusters[name].members += 1;
        all.assignment.push(name as u32);
    }
    Some(all)
}

/// A point from each of so many equal stretches of the points, of which there are more: well
/// spread if neighbours in their order are neighbours in space.
pub(super) fn stratified(points: &Points, clusters: usize, seed: u32) -> Vec<Centroid> {
    let count = points.positions.len() as u64;
    let edge = |stretch: u64| stretch * count / clusters as u64;
    (0..clusters as u64)
        .map(|stretch| {
            let (from, to) = (edge(stretch), edge(stretch + 1));
            let random = u64::from(hash(seed ^ hash(stretch as u32)));
            let point = (from + ((random * (to - from)) >> 32)) as usize;
            (points.positions[point], points.normals[point])
        })
        .collect()
}

/// Makes clusters of the points that have none, and says whether there were any.
pub(super) fn found(
    points: &Points,
    threshold: f32,
    seen: &mut Seen,
    centroids: &mut Vec<Centroid>,
) -> bool {
    let known = centroids.len();
    // The founder that accepted the last point is likely to accept the next.
    let mut founder = 0;
    let mut lost = Vec::new();
    for (at, _) in seen.assignment.iter().enumerate().filter(|(_, cluster)| **cluster == NONE) {
        let point = at * seen.stride;
        let centroid = (points.positions[point], points.normals[point]);
        let founders = &centroids[known..];
        let accepts = |founder: &Centroid| centroid.1.dot(founder.1) > threshold;
        if !founders.get(founder).is_some_and(accepts) {
            founder = founders.iter().position(accepts).unwrap_or(founders.len());
            if founder == founders.len() {
                centroids.push(centroid);
            }
        }
        lost.push((at, centroid, founder as u32));
    }
    if lost.is_empty() {
        return false;
    }
    let grid = Grid::new(centroids[known..].iter().copied());
    for (at, (position, normal), founder) in lost {
        // A founder that does not accept itself, for the rounding of its normal, stays.
        let nearest = grid.nearest(position, normal, threshold, [founder, NONE]);
        seen.assignment[at] = known as u32 + nearest.map_or(founder, |(index, _)| index);
    }
    true
}

/// A well-mixed function of 32 bits (Wellons, "Prospecting for Hash Functions", 2018).
fn hash(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}
