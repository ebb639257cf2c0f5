//! The visible points of a whole frame on the host, and their clusters.

use glam::Vec3;

use super::light_set::morton;
use super::settings::Clustering;
use crate::cluster::{Options, Points, fuzzy, kmeans};
use crate::gpu::PointRecord;

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
        let points = Points { positions: &positions, normals: &normals };
        let options = Options {
            clusters: clustering.points,
            iterations: clustering.point_iterations,
            normal_threshold: clustering.normal_threshold,
            stride: clustering.stride,
            seed,
        };
        let found = kmeans(&points, &options);
        // Rows that are neighbours in space are traced together.
        let of_cluster = |&cluster: &u32| {
            let found = &found.clusters[cluster as usize];
            records[hits[found.representative as usize] as usize]
        };
        let mut order: Vec<u32> = (0..found.clusters.len() as u32).collect();
        order.sort_by_cached_key(|c| (morton(Vec3::from_array(of_cluster(c).position)), *c));
        let representatives = order.iter().map(of_cluster).collect();
        let mut row_of = vec![0; order.len()];
        for (row, &cluster) in (0..).zip(&order) {
            row_of[cluster as usize] = row;
        }
        let rows = |clusters: &[u32]| -> Vec<u32> {
            clusters.iter().map(|&cluster| row_of[cluster as usize]).collect()
        };
        if clustering.fuzzy == 1 {
            let of_points =
                spread(&hits, &rows(&found.assignment), 1, 1, records.len(), |own| own[0]);
            return Some(Self { representatives, of_points, weights: None, shared: 1 });
        }
        let (own, shared) = (clustering.fuzzy as usize, Clustering::MOST_FUZZY as usize);
        let (clusters, weights) =
            fuzzy(&points, &found, clustering.fuzzy, clustering.normal_threshold);
        Some(Self {
            representatives,
            // A row that does not count is one that is read anyway.
            of_points: spread(&hits, &rows(&clusters), own, shared, records.len(), |own| own[0]),
            weights: Some(spread(&hits, &weights, own, shared, records.len(), |_| 0.0)),
            shared,
        })
    }
}

/// From `own` values a hit to `shared` a point: the rest of a hit's is `filler`, of others 0.
fn spread<T: Copy + Default>(
    hits: &[u32],
    values: &[T],
    own: usize,
    shared: usize,
    points: usize,
    filler: impl Fn(&[T]) -> T,
) -> Vec<T> {
    let mut all = vec![T::default(); points * shared];
    for (&hit, values) in hits.iter().zip(values.chunks_exact(own)) {
        let at = hit as usize * shared;
        all[at..at + own].copy_from_slice(values);
        all[at + own..at + shared].fill(filler(values));
    }
    all
}
