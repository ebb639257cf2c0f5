//! The framebuffer and the files it is written to and read from.

mod canvas;
mod error;
pub mod exposure;
pub mod exr;
mod framebuffer;
pub mod hdr;
pub mod heat;
pub mod input;
mod label;
mod limits;
pub mod output;
mod picture;
pub mod png;
mod primaries;
pub mod tone;

pub use error::{ImageError, OutputError};
pub use framebuffer::Image;
pub use input::{read, read_picture};
pub use output::{Destination, Format, Staged};
pub use picture::Picture;
pub use tone::Tone;
