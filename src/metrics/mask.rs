//! Pixels that a comparison leaves out.

use crate::image::Image;

/// How far the mask reaches around a bright pixel, in pixels, along rows, columns and diagonals:
/// a light's edge is antialiased.
const REACH: usize = 2;

/// Whether each pixel is kept: false within 2 pixels of any that has a channel above a level,
/// as a light seen directly has.
pub fn away_from_bright(image: &Image, level: f64) -> Vec<bool> {
    let (width, height) = (image.width as usize, image.height as usize);
    let mut keep = vec![true; image.pixels.len()];
    for (index, pixel) in image.pixels.iter().enumerate() {
        if !pixel.iter().any(|&channel| f64::from(channel) > level) {
            continue;
        }
        let (x, y) = (index % width, index / width);
        for row in y.saturating_sub(REACH)..=(y + REACH).min(height - 1) {
            let (left, right) = (x.saturating_sub(REACH), (x + REACH).min(width - 1));
            keep[row * width + left..=row * width + right].fill(false);
        }
    }
    keep
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_a_bright_pixel_is_left_out() {
        let mut image = Image { width: 7, height: 6, pixels: vec![[1.0; 3]; 42] };
        image.pixels[6] = [0.0, 1.5, 0.0];
        let keep = away_from_bright(&image, 1.0);
        let masked: Vec<_> = (0..42).filter(|&index| !keep[index]).collect();
        assert_eq!(masked, [4, 5, 6, 11, 12, 13, 18, 19, 20]);
        assert!(away_from_bright(&image, 1.5).iter().all(|&keep| keep));
    }
}
