//! Clustering: k-means of points with normals by itself, and the frames of the clustered methods.

#[path = "../common/mod.rs"]
mod common;

mod frames;
mod kmeans;
