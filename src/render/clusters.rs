//! Clusters: of visible points, which share visibility, and of VPLs, which share visibility or
//! become one light.

mod points;
mod vpls;

pub use points::PointClusters;
pub use vpls::VplClusters;
