//! Mip levels: an image at ever smaller sizes (Williams, "Pyramidal Parametrics", SIGGRAPH 1983).
//! A texel of a level is the mean, in linear light, of what it covers of the level before; where an
//! extent is odd, that is two texels and a part of a third, so that the mean of the image stays and
//! nothing moves. As no texel covers anything beyond a border, levels are the same however an
//! image wraps.

use rayon::prelude::*;

use super::{Texels, linear};

/// Colour in linear light times a weight, and the weight.
type Weighed = [f32; 4];

/// Alphas below this count as much, so that what is clear has a colour.
const LEAST_WEIGHT: f32 = 1.0 / 65536.0;

/// The sizes of the levels of an image of this size, itself the first: each half of the one before,
/// rounded down, to a single texel.
pub fn level_sizes(size: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    let half = |size: &[u32; 2]| (*size != [1, 1]).then(|| size.map(|extent| (extent / 2).max(1)));
    std::iter::successors(Some(size), half)
}

/// How many texels the levels of an image of this size have beside its own.
pub fn mip_texels(size: [u32; 2]) -> usize {
    level_sizes(size).skip(1).map(texels).sum()
}

fn texels([width, height]: [u32; 2]) -> usize {
    width as usize * height as usize
}

impl Texels {
    /// The texels of all levels but the image itself, as [`Texels::rgba`] has them, the largest
    /// level first. With `by_alpha`, texels count by their alpha: for images with holes, in which
    /// what has been cut out is not seen. Alpha itself is the mean.
    pub fn mips(&self, by_alpha: bool) -> Vec<[u8; 4]> {
        let decoded: Vec<f32> = (0..=u8::MAX).map(|v| linear(f32::from(v) / 255.0)).collect();
        // Between the values of neighbouring codes: a value gets the code that is nearest in linear
        // light.
        let borders: Vec<f32> = decoded.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
        let weigh = |[r, g, b, a]: [u8; 4]| {
            let alpha = f32::from(a) / 255.0;
            let weight = if by_alpha { alpha.max(LEAST_WEIGHT) } else { 1.0 };
            let [r, g, b] = [r, g, b].map(|value| weight * decoded[usize::from(value)]);
            [r, g, b, if by_alpha { weight } else { alpha }]
        };
        let encode = |[r, g, b, a]: Weighed| {
            let weight = if by_alpha { a } else { 1.0 };
            let code =
                |value: f32| borders.partition_point(|&border| border <= value / weight) as u8;
            [code(r), code(g), code(b), (255.0 * a).round() as u8]
        };
        let mut all = Vec::with_capacity(mip_texels(self.size));
        let mut before: Option<Vec<Weighed>> = None;
        for (from, to) in level_sizes(self.size).zip(level_sizes(self.size).skip(1)) {
            let level = match &before {
                None => halve(from, to, |at| weigh(self.rgba[at])),
                Some(before) => halve(from, to, |at| before[at]),
            };
            all.par_extend(level.par_iter().map(|&value| encode(value)));
            before = Some(level);
        }
        all
    }
}

/// A level of one size from that of another.
fn halve(from: [u32; 2], to: [u32; 2], texel: impl Fn(usize) -> Weighed + Sync) -> Vec<Weighed> {
    let width = from[0] as usize;
    let columns: Vec<_> = (0..to[0]).map(|x| covered(x, from[0], to[0])).collect();
    let mut level = vec![[0.0; 4]; texels(to)];
    level.par_chunks_mut(to[0] as usize).zip(0..to[1]).for_each(|(row, y)| {
        let rows = covered(y, from[1], to[1]);
        for (value, columns) in row.iter_mut().zip(&columns) {
            for (y, down) in rows.into_iter().filter(|(_, part)| *part > 0.0) {
                for &(x, across) in columns.iter().filter(|(_, part)| *part > 0.0) {
                    let before = texel(y as usize * width + x as usize);
                    *value = std::array::from_fn(|i| value[i] + down * across * before[i]);
                }
            }
        }
    });
    level
}

/// The texels along an axis that the one at `index` of the next level covers, and how much of it
/// each is; where there are fewer than three, the last again, with a weight of 0.
fn covered(index: u32, from: u32, to: u32) -> [(u32, f32); 3] {
    if from == to {
        return [(index, 1.0), (index, 0.0), (index, 0.0)];
    }
    let (first, share) = (2 * index, 1.0 / from as f32);
    if from.is_multiple_of(2) {
        return [(first, 0.5), (first + 1, 0.5), (first + 1, 0.0)];
    }
    let part = |texels: u32| texels as f32 * share;
    [(first, part(to - index)), (first + 1, part(to)), (first + 2, part(index + 1))]
}
