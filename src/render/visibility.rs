//! Shadow rays between points and many lights: which row of the bit matrix sees which light.

mod light_set;
mod probes;
mod trace;

pub use light_set::{LightSet, table};
pub use probes::Probes;
pub use trace::{Tracer, dispatch_rays};
