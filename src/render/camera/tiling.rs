//! The order of the pixels: 8 × 8 blocks in rows, tiles of blocks, samples of tiles; and the
//! way from tiles back to an image.

use std::ops::Range;

use crate::gpu::GpuError;
use crate::image::Image;
use crate::render::settings::Settings;
use crate::scene::Camera;

/// Pixels of a block of 8 × 8.
pub const BLOCK: u32 = 64;

/// How the blocks of an image make tiles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tiling {
    /// Blocks across the image.
    across: u32,
    /// Blocks of the image.
    all: u32,
    /// Blocks that a tile is responsible for, at most.
    own: u32,
    /// Blocks that a tile also has before and after them, for what needs the pixels around.
    around: u32,
    /// Samples a pixel.
    samples: u32,
}

/// A run of blocks, and the sample of its pixels that is being taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tile {
    /// The first of its blocks in the image.
    pub first_block: u32,
    /// How many blocks it has.
    pub blocks: u32,
    /// Which sample of each pixel.
    pub sample: u32,
    /// The first of the blocks that it's responsible for, counted from `first_block`.
    own_first: u32,
    /// How many those are.
    own_blocks: u32,
    /// Blocks of the image.
    all: u32,
}

impl Tiling {
    /// Tiles as large as what they hold a point allows: much, if every point has a row of the bit
    /// matrix. Interleaving and antialiasing need the pixels around, and so rows.
    pub fn of(camera: &Camera, settings: &Settings) -> Self {
        let own_rows = settings.method.is_indirect() && !settings.method.clusters_points();
        let blocks = if own_rows && !settings.interleaves() { 4096 } else { 16_384 };
        match settings.interleaves() || settings.antialiases() || settings.filters_direct() {
            true => Self::of_rows(camera, blocks, settings.samples),
            false => Self::of_runs(camera, blocks, settings.samples),
        }
    }

    /// Tiles of at most so many blocks, of any shape.
    pub fn of_runs(camera: &Camera, blocks: u32, samples: u32) -> Self {
        let [across, down] = camera.size.map(|extent| extent.div_ceil(8));
        let all = across * down;
        Self { across, all, own: blocks.min(all), around: 0, samples }
    }

    /// Tiles of whole rows of blocks, about so many blocks each, with a row more on either side.
    pub fn of_rows(camera: &Camera, blocks: u32, samples: u32) -> Self {
        let [across, down] = camera.size.map(|extent| extent.div_ceil(8));
        let own = across * (blocks / across).clamp(1, down);
        Self { across, all: across * down, own, around: across, samples }
    }

    /// Blocks across the image.
    pub fn across(&self) -> u32 {
        self.across
    }

    /// Points of a tile, at most.
    pub fn most_points(&self) -> u32 {
        (self.own + 2 * self.around).min(self.all) * BLOCK
    }

    /// Points of the whole frame.
    pub fn all_points(&self) -> usize {
        self.samples as usize * self.all as usize * BLOCK as usize
    }

    /// All tiles with all their samples, sample after sample.
    pub fn tiles(self) -> impl Iterator<Item = Tile> {
        (0..self.all).step_by(self.own as usize).flat_map(move |first| {
            let end = (first + self.own).min(self.all);
            let first_block = first.saturating_sub(self.around);
            let blocks = (end + self.around).min(self.all) - first_block;
            (0..self.samples).map(move |sample| Tile {
                first_block,
                blocks,
                sample,
                own_first: first - first_block,
                own_blocks: end - first,
                all: self.all,
            })
        })
    }
}

impl Tile {
    /// How many points it has.
    pub fn points(&self) -> u32 {
        self.blocks * BLOCK
    }

    /// The points that it is responsible for.
    pub fn own(&self) -> Range<usize> {
        let points = |blocks: u32| blocks as usize * BLOCK as usize;
        points(self.own_first)..points(self.own_first + self.own_blocks)
    }

    /// Its points among all of a frame's: a sample of the whole image, then the next.
    pub fn of_frame(&self) -> Range<usize> {
        let before = self.sample as usize * self.all as usize + self.first_block as usize;
        let first = before * BLOCK as usize;
        first..first + self.points() as usize
    }
}

/// Puts what a tile is responsible for of its film into the image, each channel times
/// `weight`. Returns how many samples hit something.
pub fn develop(tile: Tile, film: &[[f32; 4]], weight: f32, image: &mut Image) -> u64 {
    let mut hits = 0;
    for point in tile.own() {
        let texel = film[point];
        let [x, y] = pixel_of(point as u32, tile.first_block, image.width);
        if x < image.width && y < image.height {
            let at = y as usize * image.width as usize + x as usize;
            image.pixels[at] = [texel[0], texel[1], texel[2]].map(|sum| sum * weight);
            hits += texel[3] as u64;
        }
    }
    hits
}

/// The pixel of a point; the twin of `pixel_of` in `shaders/common/pixels.wgsl`.
pub fn pixel_of(point: u32, first_block: u32, width: u32) -> [u32; 2] {
    let across = width.div_ceil(8);
    let block = first_block + point / BLOCK;
    let i = point % BLOCK;
    let x = (i & 1) | (i >> 1 & 2) | (i >> 2 & 4);
    let y = (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4);
    [block % across * 8 + x, block / across * 8 + y]
}

/// The point of a pixel, if the image is one tile: the inverse of [`pixel_of`].
pub fn point_of([x, y]: [u32; 2], width: u32) -> u32 {
    let spread = |x: u32| (x & 1) | (x & 2) << 1 | (x & 4) << 2;
    (y / 8 * width.div_ceil(8) + x / 8) * BLOCK + (spread(x) | spread(y) << 1)
}

/// A black image, if there is memory for one.
pub fn blank([width, height]: [u32; 2]) -> Result<Image, GpuError> {
    let count = width as usize * height as usize;
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(count).map_err(|_| GpuError::ImageTooLarge {
        width,
        height,
        bytes: (count * size_of::<[f32; 3]>()) as u64,
    })?;
    pixels.resize(count, [0.0; 3]);
    Ok(Image { width, height, pixels })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn camera(size: [u32; 2]) -> Camera {
        Camera { size, ..Scene::load("builtin:cornell").unwrap().camera }
    }

    #[test]
    fn the_point_of_a_pixel_is_the_inverse_of_the_pixel_of_a_point() {
        for width in [8, 40, 512] {
            for point in 0..width * 24 {
                assert_eq!(point_of(pixel_of(point, 0, width), width), point);
            }
        }
    }

    #[test]
    fn tiles_are_responsible_for_every_point_once() {
        let camera = camera([100, 70]);
        for tiling in [Tiling::of_runs(&camera, 20, 3), Tiling::of_rows(&camera, 30, 3)] {
            let mut seen = vec![0; 3 * 13 * 9 * 64];
            for tile in tiling.tiles() {
                assert!(tile.points() <= tiling.most_points());
                let first = tile.of_frame().start;
                tile.own().for_each(|point| seen[first + point] += 1);
            }
            assert!(seen.iter().all(|&times| times == 1), "{tiling:?}");
        }
    }

    #[test]
    fn tiles_of_rows_see_the_row_before_and_after() {
        let tiles: Vec<Tile> = Tiling::of_rows(&camera([100, 70]), 30, 1).tiles().collect();
        let rows: Vec<[u32; 2]> = tiles.iter().map(|t| [t.first_block, t.blocks]).collect();
        assert_eq!(rows, [[0, 39], [13, 52], [39, 52], [65, 52], [91, 26]]);
    }
}
