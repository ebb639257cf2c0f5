//! Virtual point lights (VPLs), on the host: light paths, what they leave where they hit, and the
//! bound on the geometry term that follows from it.

mod bound;
mod candidates;
mod density;
mod importance;
mod select;
mod set;
mod sights;
mod starts;
mod trace;
mod warp;

pub use bound::GeometryBound;
pub use set::{VplSet, light_paths};
pub use starts::Starts;
pub use trace::{LightPaths, Vpl};
