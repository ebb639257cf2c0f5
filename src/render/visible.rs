//! The visible points of a whole frame on the host, and their clusters.

use glam::Vec3;

use super::settings::Clustering;
use crate::cluster::{Options, Points, kmeans};
use crate::gpu::PointRecord;

/// Clusters of visible points: which of them share visibility.
#[derive(Debug, Clone)]
pub struct PointClusters {
    /// The member of each cluster that traces its rays.
    pub representatives: Vec<PointRecord>,
    /// The cluster of each visible point; 0 where a camera ray hit nothing.
    pub of_points: Vec<u32>,
}

impl PointClusters {
    /// Clusters the points by position, where their normals agree. `None` if there are none.
    pub fn of(records: &[PointRecord], clustering: &Clustering, seed: u32) -> Option<Self> {
        let hits: Vec<u32> = (0..)
            .zip(records)
            .filter(|(_, record)| record.surface != PointRecord::NOTHING)
            .map(|(index, _)| index)
            .collect();
        if hits.is_empty() {
            return None;
        }
        let of = |field: fn(&PointRecord) -> [f32; 3]| -> Vec<Vec3> {
            hits.iter().map(|&hit| Vec3::from_array(field(&records[hit as usize]))).collect()
        };
        let positions = of(|record| record.position);
        let normals = of(|record| record.normal);
        let found = kmeans(
            &Points { positions: &positions, normals: &normals },
            &Options {
                clusters: clustering.points,
                iterations: clustering.point_iterations,
                normal_threshold: clustering.normal_threshold,
                stride: clustering.stride,
                seed,
            },
        );
        let representative = |member: u32| records[hits[member as usize] as usize];
        let mut of_points = vec![0; records.len()];
        for (&hit, &cluster) in hits.iter().zip(&found.assignment) {
            of_points[hit as usize] = cluster;
        }
        Some(Self {
            representatives: found
                .clusters
                .iter()
                .map(|cluster| representative(cluster.representative))
                .collect(),
            of_points,
        })
    }
}
