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

mod assignment;
mod fuzzy;
mod grid;
mod kmeans;
mod members;
mod morton;
mod points;
mod scale;
mod start;

pub use fuzzy::fuzzy;
pub use grid::Grid;
pub use kmeans::{Options, kmeans};
pub use morton::morton;
pub use points::{Cluster, Clusters, Points};
