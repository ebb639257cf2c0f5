//! Studies: what is to be measured as data ([`Plan`]), measured frame by frame and kept on disk
//! ([`Store`]), and what came of it ([`Results`]) as tables, plots and a page.

mod claims;
pub mod csv;
mod decompose;
mod event;
pub mod fit;
mod found;
pub mod markdown;
mod measure;
pub mod options;
pub mod page;
pub mod parts;
mod plan;
pub mod plot;
pub mod presets;
mod reference;
pub mod results;
mod spread;
mod store;
mod summary;
pub mod thesis;
mod verdict;
mod work;

pub use event::{Event, Tell};
pub use found::{Found, FoundFrame};
pub use measure::Measured;
pub use plan::{Decompose, Experiment, Plan, ReferencePlan, Run, Transport, unclustered};
pub use reference::Reference;
pub use results::{Results, Row};
pub use store::{Store, name_of_program, store_in};
pub use verdict::{Claim, Verdict};
pub use work::Study;
