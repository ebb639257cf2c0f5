//! An image in memory.

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

impl Image {
    /// How many pixels hold an infinity or a NaN.
    pub fn nonfinite(&self) -> u64 {
        self.pixels.iter().filter(|rgb| !rgb.iter().all(|c| c.is_finite())).count() as u64
    }

    /// Column and row of the first pixel that holds an infinity or a NaN.
    pub fn first_nonfinite(&self) -> Option<[usize; 2]> {
        let width = self.width.max(1) as usize;
        let index = self.pixels.iter().position(|rgb| !rgb.iter().all(|c| c.is_finite()))?;
        Some([index % width, index / width])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_pixel_that_is_not_finite_is_found() {
        let mut image = Image { width: 3, height: 2, pixels: vec![[0.5; 3]; 6] };
        assert_eq!((image.first_nonfinite(), image.nonfinite()), (None, 0));
        image.pixels[5] = [f32::INFINITY, 0.0, 0.0];
        image.pixels[4] = [0.0, 0.0, f32::NAN];
        assert_eq!((image.first_nonfinite(), image.nonfinite()), (Some([1, 1]), 2));
    }
}
