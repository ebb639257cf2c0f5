//! Light from all directions, from infinitely far away.

pub mod omitted;
mod packing;
mod radiance;
mod read;
mod turn;

pub use packing::{MOST, pack, unpack};
pub use radiance::{Environment, EnvironmentImage, direction, place};
pub(super) use read::read;
