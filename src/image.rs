//! The framebuffer and the files it is written to.

/// A linear RGB image, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rec. 709 radiance (or the data of an AOV), `width * height` of them.
    pub pixels: Vec<[f32; 3]>,
}
