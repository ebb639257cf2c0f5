//! Shadow rays of each visible point that correct what it shares of the visibility of VPLs.

use crate::gpu::{CorrectParams, ShadeParams};
use crate::render::camera::Tile;
use crate::render::prepared::Prepared;
use crate::sampling::{SURFACE_OFFSET, hash};

/// Keeps the random numbers of corrections apart from those of other stages.
const STREAM: u32 = 0x636f_7272;

/// How many there are.
#[derive(Debug, Clone, Copy)]
pub struct Corrections {
    /// Of each visible point.
    pub rays: u32,
    /// The seed of the frame.
    pub seed: u32,
}

impl Corrections {
    /// Of the points and the chunk of the bit matrix that are shaded so, the chunk being one of so many.
    pub fn params(
        self,
        prepared: &Prepared,
        tile: Tile,
        shade: &ShadeParams,
        [chunk, chunks]: [u32; 2],
    ) -> CorrectParams {
        let ShadeParams { points, rows, matrix_word, words, first_point, .. } = *shade;
        CorrectParams {
            points,
            rows,
            matrix_word,
            words,
            first_point,
            rays: self.rays,
            first_ray: tile.sample * self.rays,
            seed: hash(hash(self.seed ^ STREAM) ^ hash(tile.first_block)),
            offset: SURFACE_OFFSET,
            nodes: prepared.bvh.nodes.len() as u32,
            chunk,
            chunks,
        }
    }
}
