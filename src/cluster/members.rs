//! The members of each cluster, and what follows from them.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::assignment::Seen;
use super::points::{Centroid, Cluster, Points};

/// Points sorted by cluster, in their order within it.
pub(super) struct Members {
    /// Where each cluster starts, and one more.
    starts: Vec<u32>,
    points: Vec<u32>,
}

impl Members {
    pub fn new(seen: &Seen, clusters: usize) -> Self {
        let mut starts = vec![0; clusters + 1];
        for &cluster in &seen.assignment {
            starts[cluster as usize + 1] += 1;
        }
        for cluster in 0..clusters {
            starts[cluster + 1] += starts[cluster];
        }
        let mut next = starts.clone();
        let mut points = vec![0; seen.assignment.len()];
        for (at, &cluster) in seen.assignment.iter().enumerate() {
            let place = &mut next[cluster as usize];
            points[*place as usize] = (at * seen.stride) as u32;
            *place += 1;
        }
        Self { starts, points }
    }

    pub fn clusters(&self) -> usize {
        self.starts.len() - 1
    }

    fn of(&self, cluster: usize) -> &[u32] {
        &self.points[self.starts[cluster] as usize..self.starts[cluster + 1] as usize]
    }

    /// Position and normal of a cluster's mean, if it has members.
    fn mean(&self, points: &Points, cluster: usize) -> Option<Centroid> {
        let members = self.of(cluster);
        if members.is_empty() {
            return None;
        }
        let (mut position, mut normal) = (DVec3::ZERO, DVec3::ZERO);
        for &member in members {
            position += points.positions[member as usize].as_dvec3();
            normal += points.normals[member as usize].as_dvec3();
        }
        let count = members.len() as f64;
        let position = (position / count).as_vec3();
        // What rounding leaves of normals that cancel is no direction.
        let normal = match normal.length() {
            length if length > 1e-6 * count => (normal / length).as_vec3(),
            _ => points.normals[self.nearest(points, cluster, position) as usize],
        };
        Some((position, normal))
    }

    /// The member nearest to a position, the first of several.
    fn nearest(&self, points: &Points, cluster: usize, position: Vec3) -> u32 {
        let members = self.of(cluster);
        let mut best = (members[0], f32::INFINITY);
        for &member in members {
            let distance = points.positions[member as usize].distance_squared(position);
            if distance < best.1 {
                best = (member, distance);
            }
        }
        best.0
    }

    /// A cluster, if it has members.
    pub fn cluster(&self, points: &Points, index: usize) -> Option<Cluster> {
        let (position, normal) = self.mean(points, index)?;
        let representative = self.nearest(points, index, position);
        Some(Cluster { position, normal, representative, members: self.of(index).len() as u32 })
    }

    /// Moves centroids to the means of their members, and says whether any has moved. One
    /// without members goes to the point farthest from its centroid, the next to the next;
    /// it stays where only a part of the points were seen.
    pub fn update(&self, points: &Points, seen: &Seen, centroids: &mut [Centroid]) -> bool {
        let empty: Vec<_> = match seen.stride {
            1 => (0..self.clusters()).filter(|&cluster| self.of(cluster).is_empty()).collect(),
            _ => Vec::new(),
        };
        let farthest = farthest(points, seen, centroids, empty.len());
        let moved = centroids.par_iter_mut().enumerate().with_min_len(16).map(|(index, from)| {
            let to = self.mean(points, index).unwrap_or(*from);
            std::mem::replace(from, to) != to
        });
        let moved = moved.reduce(|| false, |a, b| a | b);
        for (&cluster, &point) in empty.iter().zip(&farthest) {
            centroids[cluster] = (points.positions[point], points.normals[point]);
        }
        moved | !farthest.is_empty()
    }
}

/// Up to so many points, those farthest from their centroids first, none of them on its.
fn farthest(points: &Points, seen: &Seen, centroids: &[Centroid], count: usize) -> Vec<usize> {
    if count == 0 {
        return Vec::new();
    }
    let assigned = seen.assignment.iter().enumerate();
    let mut far: Vec<_> = assigned
        .map(|(at, &cluster)| {
            let point = at * seen.stride;
            (points.positions[point].distance_squared(centroids[cluster as usize].0), point)
        })
        .filter(|&(distance, _)| distance > 0.0)
        .collect();
    let order = |a: &(f32, usize), b: &(f32, usize)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
    if far.len() > count {
        far.select_nth_unstable_by(count - 1, order);
        far.truncate(count);
    }
    far.sort_unstable_by(order);
    far.into_iter().map(|(_, point)| point).collect()
}
