//! An image file as it was read.

use super::Image;

/// An image, and what else its file says of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Linear, in the primaries of Rec. 709.
    pub image: Image,
    /// Coverage of each pixel, if the file holds it.
    pub alpha: Option<Vec<f32>>,
    /// The layer that was read, if it has a name.
    pub layer: Option<String>,
    /// What was read otherwise than it stands, or left out.
    pub notes: Vec<String>,
}

impl Picture {
    /// An image without anything else.
    pub fn of(image: Image) -> Self {
        Self { image, alpha: None, layer: None, notes: Vec::new() }
    }
}
