//! Clusters of the visible points of a frame, and outliers of them that are clustered anew.

use std::ops::Range;

use glam::Vec3;
use rayon::prelude::*;

use crate::cluster::morton;
use crate::cluster::{Options, Points, fuzzy, kmeans};
use crate::gpu::PointRecord;
use crate::render::settings::Clustering;

/// A point outliers from its cluster if it sees otherwise than it at least so many of the probes.
const OUTLIER_DIFFERENCES: u32 = 2;
/// Clusters of outliers are so many times as dense as those of all points.
const OUTLIER_DENSITY: usize = 16;
/// How much a cluster counts in a fuzzy mean that sees one probe otherwise than the point.
const UNLIKE: f32 = 0.25;

/// Clusters of visible points: which of them share visibility.
#[derive(Debug, Clone)]
pub struct PointClusters {
    /// The member of each cluster that traces its rays.
    pub representatives: Vec<PointRecord>,
    /// The clusters of each visible point, `shared` of them a point; 0 where a camera ray hit
    /// nothing.
    pub of_points: Vec<u32>,
    /// Their weights, if there are several a point.
    pub weights: Option<Vec<f32>>,
    /// Clusters a point: 1, or [`Clustering::MOST_FUZZY`].
    pub shared: usize,
}

impl PointClusters {
    /// Clusters the points by position, where their normals agree. With `probes`, a word a
    /// point whose bits are whether it sees each of a few lights, points that see others than
    /// their cluster's representative are clustered anew among themselves. `None` if there are
    /// no points.
    pub fn of(
        records: &[PointRecord],
        probes: Option<&[u32]>,
        clustering: &Clustering,
        seed: u32,
    ) -> Option<Self> {
        let hits: Vec<u32> = (0..)
            .zip(records)
            .filter(|(_, record)| record.surface != PointRecord::NOTHING)
            .map(|(index, _)| index)
            .collect();
        if hits.is_empty() {
            return None;
        }
        let mut parts =
            vec![PartialClusters::of(records, hits, clustering, clustering.points, seed)];
        if let Some(probes) = probes {
            let outliers = parts[0].outliers(probes);
            if !outliers.is_empty() {
                let clusters = clustering.points as usize * OUTLIER_DENSITY * outliers.len();
                let clusters = clusters.div_ceil(parts[0].points.len()) as u32;
                parts.push(PartialClusters::of(records, outliers, clustering, clusters, seed));
            }
            for part in &mut parts {
                part.weigh_by_probes(probes);
            }
        }
        Some(Self::join(records, &parts))
    }

    /// The cluster of each of a range of the points that counts most for it.
    pub fn nearest(&self, points: Range<usize>) -> Vec<u32> {
        let of_point = |point: usize| {
            let first = point * self.shared;
            let clusters = first..first + self.shared;
            let weight = |&at: &usize| self.weights.as_ref().map_or(1.0, |weights| weights[at]);
            // The first of those that count alike.
            let most = clusters.rev().max_by(|a, b| weight(a).total_cmp(&weight(b)));
            self.of_points[most.unwrap_or(first)]
        };
        points.map(of_point).collect()
    }

    /// The clusters of all parts, where a later part has its points for itself.
    fn join(records: &[PointRecord], parts: &[PartialClusters]) -> Self {
        let all: Vec<u32> = parts.iter().flat_map(|part| part.representatives.clone()).collect();
        // Rows that are neighbours in space are traced together.
        let place = |&index: &u32| {
            let record = &records[all[index as usize] as usize];
            (morton(Vec3::from_array(record.position)), index)
        };
        let mut order: Vec<u32> = (0..all.len() as u32).collect();
        order.sort_by_cached_key(place);
        let mut row_of = vec![0; order.len()];
        for (row, &index) in (0..).zip(&order) {
            row_of[index as usize] = row;
        }
        let representatives =
            order.iter().map(|&index| records[all[index as usize] as usize]).collect();
        let shared = parts[0].shared();
        let mut of_points = vec![0; records.len() * shared];
        let mut weights = parts[0].weights.as_ref().map(|_| vec![0.0; records.len() * shared]);
        let mut before = 0;
        for part in parts {
            let own = part.own();
            for (at, &point) in part.points.iter().enumerate() {
                let to = point as usize * shared;
                let rows = part.clusters[at * own..][..own].iter();
                for (slot, cluster) in (to..).zip(rows) {
                    of_points[slot] = row_of[before + *cluster as usize];
                }
                // A row that does not count is one that is read anyway.
                let first = of_points[to];
                of_points[to + own..to + shared].fill(first);
                if let (Some(weights), Some(from)) = (&mut weights, &part.weights) {
                    weights[to..to + own].copy_from_slice(&from[at * own..][..own]);
                    weights[to + own..to + shared].fill(0.0);
                }
            }
            before += part.representatives.len();
        }
        Self { representatives, of_points, weights, shared }
    }
}

/// Clusters of some of the points.
struct PartialClusters {
    /// The points, by their indices among all.
    points: Vec<u32>,
    /// The points that stand for the clusters.
    representatives: Vec<u32>,
    /// The cluster of each point.
    assignment: Vec<u32>,
    /// The clusters of each point, several if fuzzy.
    clusters: Vec<u32>,
    /// Their weights.
    weights: Option<Vec<f32>>,
}

impl PartialClusters {
    fn of(
        records: &[PointRecord],
        points: Vec<u32>,
        clustering: &Clustering,
        clusters: u32,
        seed: u32,
    ) -> Self {
        let of = |field: fn(&PointRecord) -> [f32; 3]| -> Vec<Vec3> {
            points.iter().map(|&point| Vec3::from_array(field(&records[point as usize]))).collect()
        };
        let positions = of(|record| record.position);
        let normals = of(|record| record.normal);
        let places = Points { positions: &positions, normals: &normals };
        let options = Options {
            clusters,
            iterations: clustering.point_iterations,
            normal_threshold: clustering.normal_threshold,
            stride: clustering.stride,
            seed,
        };
        let found = kmeans(&places, &options);
        let representatives =
            found.clusters.iter().map(|cluster| points[cluster.representative as usize]).collect();
        let (clusters, weights) = if clustering.fuzzy == 1 {
            (found.assignment.clone(), None)
        } else {
            let (clusters, weights) =
                fuzzy(&places, &found, clustering.fuzzy, clustering.normal_threshold);
            (clusters, Some(weights))
        };
        Self { points, representatives, assignment: found.assignment, clusters, weights }
    }

    /// Clusters that a point has.
    fn own(&self) -> usize {
        self.clusters.len() / self.points.len()
    }

    /// Clusters that the shading kernel reads for a point.
    fn shared(&self) -> usize {
        if self.weights.is_some() { Clustering::MOST_FUZZY as usize } else { 1 }
    }

    /// Lets a cluster count less for a point that sees others of the probes than it does.
    fn weigh_by_probes(&mut self, probes: &[u32]) {
        let (own, representatives) = (self.own(), &self.representatives);
        let Some(weights) = &mut self.weights else { return };
        let each = weights.par_chunks_exact_mut(own).zip(self.clusters.par_chunks_exact(own));
        each.zip(&self.points).for_each(|((weights, clusters), &point)| {
            for (weight, &cluster) in weights.iter_mut().zip(clusters) {
                let representative = representatives[cluster as usize];
                *weight *= UNLIKE.powi(differences(probes, point, representative) as i32);
            }
            // Never 0: of the weights, which sum to 1, the largest is at least 1/m.
            let sum: f32 = weights.iter().sum();
            weights.iter_mut().for_each(|weight| *weight /= sum);
        });
    }

    /// The points that see others of the probes than their cluster's representative does.
    fn outliers(&self, probes: &[u32]) -> Vec<u32> {
        let of_points = self.points.iter().zip(&self.assignment);
        let outliers = of_points.filter(|&(&point, &cluster)| {
            let representative = self.representatives[cluster as usize];
            differences(probes, point, representative) >= OUTLIER_DIFFERENCES
        });
        outliers.map(|(&point, _)| point).collect()
    }
}

/// Of how many probes two points see only one.
fn differences(probes: &[u32], point: u32, other: u32) -> u32 {
    (probes[point as usize] ^ probes[other as usize]).count_ones()
}
