//! Points, and clusters of them.

use glam::Vec3;

/// Stands for "no cluster" in an assignment that is not finished.
pub const NONE: u32 = u32::MAX;

/// So many points are searched by one thread at a time.
pub const CHUNK: usize = 2048;

/// Points with facing unit normals, as many of these as of those; all finite.
#[derive(Debug, Clone, Copy)]
pub struct Points<'a> {
    /// Where the points are, in any unit.
    pub positions: &'a [Vec3],
    /// Their unit normals.
    pub normals: &'a [Vec3],
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
pub struct Clusters {
    /// The clusters, none of them empty.
    pub clusters: Vec<Cluster>,
    /// The index of its cluster, for each point.
    pub assignment: Vec<u32>,
    /// Iterations done; 0 if every distinct point is a cluster.
    pub iterations: u32,
}

/// Position and normal of a centroid.
pub type Centroid = (Vec3, Vec3);
