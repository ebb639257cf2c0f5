//! From camera rays to the film: tiles of the image, the points that they see, what comes back of
//! the radiance of those.

mod antialiasing;
mod attributes;
mod buffers;
mod emission;
mod rays;
mod setup;
mod tiling;

pub use attributes::{Attribute, attributes};
pub use buffers::TileBuffers;
pub use emission::Emission;
pub use rays::{CameraRays, camera_params};
pub use setup::FrameSetup;
pub use tiling::{BLOCK, Tile, Tiling, blank, develop, pixel_of, point_of};
