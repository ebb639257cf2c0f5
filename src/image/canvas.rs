//! An 8-bit image to draw on.

/// An 8-bit RGB image to draw on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Canvas {
    /// Pixels in a row, rows.
    pub size: [u32; 2],
    /// Row by row.
    pub bytes: Vec<u8>,
}

impl Canvas {
    pub(super) fn black([width, height]: [usize; 2]) -> Self {
        Self { size: [width as u32, height as u32], bytes: vec![0; width * height * 3] }
    }

    /// Fills a rectangle, given its upper left corner, as far as it lies on the canvas.
    pub fn fill(&mut self, corner: [usize; 2], extent: [usize; 2], colour: [u8; 3]) {
        let [width, height] = self.size.map(|extent| extent as usize);
        let [right, bottom] =
            [(corner[0] + extent[0]).min(width), (corner[1] + extent[1]).min(height)];
        for y in corner[1]..bottom {
            for x in corner[0]..right {
                self.bytes[(y * width + x) * 3..][..3].copy_from_slice(&colour);
            }
        }
    }
}
