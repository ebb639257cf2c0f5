//! Virtual point lights (VPLs), on the host: light paths, what they leave where they hit, and the
//! bound on the geometry term that follows from it.

mod bound;
mod set;
mod trace;

pub use set::{VplSet, light_paths};
pub use trace::{LightPaths, Vpl};
