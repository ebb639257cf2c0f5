//! Light from all directions, from infinitely far away.

mod packing;
mod radiance;
mod read;

pub use packing::{MOST, pack, unpack};
pub use radiance::{Environment, EnvironmentImage, direction, place};
pub(super) use read::read;
