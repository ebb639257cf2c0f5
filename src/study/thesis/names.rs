//! Names of the experiments, as rows and claims refer to them.

/// Every VPL by itself.
pub const TABLE_VPL: &str = "table 5.2";
/// VPL clusters.
pub const TABLE_VPLC: &str = "table 5.3";
/// Point clusters.
pub const TABLE_VPC: &str = "table 5.4";
/// Both.
pub const TABLE_BOTH: &str = "table 5.5";
/// Claim: time is linear in the number of VPLs.
pub const LINEAR: &str = "linear";
/// Claim: little changes after a few iterations.
pub const ITERATIONS: &str = "iterations";
/// Claim: a stride makes clustering faster.
pub const STRIDE: &str = "stride";
/// Claim: VPL clusters look like VPLs.
pub const CLUSTERS: &str = "clusters";
/// Claim: VPLs beat path tracing.
pub const PATH: &str = "path";
