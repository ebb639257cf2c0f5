//! Gathering the light of many lights at the visible points, and combining it over pixels.

mod clamped;
mod columns;
mod correct;
mod interleave;
mod irradiance;
mod many_lights;

pub use clamped::ClampedEnergy;
pub use correct::Corrections;
pub use interleave::Interleave;
pub use irradiance::Irradiance;
pub use many_lights::{Gather, Sights, chunk_words};
