//! The framebuffer and the files it is written to and read from.

mod canvas;
mod error;
pub mod exr;
mod framebuffer;
pub mod heat;
pub mod input;
mod label;
mod limits;
pub mod output;
pub mod png;
pub mod tone;

pub use error::{ImageError, OutputError};
pub use framebuffer::Image;
pub use input::read;
pub use output::{Destination, Format, Staged};
pub use tone::Tone;
