//! The order of the pixels in tiles, and the way from tiles back to an image.

use crate::image::Image;
use crate::scene::Camera;

/// Pixels of a block of 8 × 8.
pub const BLOCK: u32 = 64;
/// Blocks of a tile: 65,536 points.
pub const TILE_BLOCKS: u32 = 1024;

/// Blocks that cover the image.
pub fn image_blocks(camera: &Camera) -> u32 {
    let [width, height] = camera.size;
    width.div_ceil(8) * height.div_ceil(8)
}

/// Puts a tile's film into the image, each channel times `weight`. Returns how many samples
/// hit something.
pub fn develop(first_block: u32, film: &[[f32; 4]], weight: f32, image: &mut Image) -> u64 {
    let mut hits = 0;
    for (point, texel) in (0..).zip(film) {
        let [x, y] = pixel_of(point, first_block, image.width);
        if x < image.width && y < image.height {
            let at = y as usize * image.width as usize + x as usize;
            image.pixels[at] = [texel[0], texel[1], texel[2]].map(|sum| sum * weight);
            hits += texel[3] as u64;
        }
    }
    hits
}

/// The pixel of a point; the twin of `pixel_of` in `shaders/sampling.wgsl`.
pub fn pixel_of(point: u32, first_block: u32, width: u32) -> [u32; 2] {
    let across = width.div_ceil(8);
    let block = first_block + point / BLOCK;
    let i = point % BLOCK;
    let x = (i & 1) | (i >> 1 & 2) | (i >> 2 & 4);
    let y = (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4);
    [block % across * 8 + x, block / across * 8 + y]
}
