//! Shadow rays between points and many lights: which row of the bit matrix sees which light.

mod light_set;
mod members;
mod probes;
mod trace;

pub use light_set::{ColumnEnds, Columns, LightSet, SharedColumns, table};
pub use members::{Draws, MemberRays};
pub use probes::Probes;
pub use trace::{Tracer, dispatch_rays};
