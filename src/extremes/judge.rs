//! Images measured against what they must be.

use super::Figure;
use super::cases::{Expect, Like};
use crate::image::Image;
use crate::metrics::{Comparison, largest};

/// Pixels along a tile.
const TILE: u32 = 16;

/// An image and how it is looked at.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a> {
    /// The image.
    pub image: &'a Image,
    /// The method that made it.
    pub method: &'static str,
    /// The part that counts, of the whole's width and height: left, top, right, bottom.
    pub region: Option<[f64; 4]>,
}

/// The figures of an image: what it must be, and is. What it must be like is `other`.
pub fn judge(expect: &Expect, within: f64, seen: Seen<'_>, other: Option<&Image>) -> Vec<Figure> {
    match expect {
        Expect::Mean(radiance) => vec![seen.mean("mean", radiance.channels(), within)],
        Expect::EveryPixel(radiance) => vec![seen.every_pixel(radiance.channels(), within)],
        Expect::EveryTile(radiance) => vec![seen.every_tile(radiance.channels(), within)],
        Expect::Black => vec![seen.black()],
        Expect::Finite => vec![seen.finite()],
        Expect::Like(like) => match other {
            Some(other) => seen.like(like, other),
            None => vec![seen.figure("likeness to an image that is not there", 1.0, f64::NAN, 0.0)],
        },
        // An image that there is was not refused.
        Expect::Refused(_) => vec![seen.figure("refused", 1.0, 0.0, 0.0)],
    }
}

impl Seen<'_> {
    /// A figure whose error is relative to what is expected; absolute if that is 0.
    fn figure(&self, what: impl Into<String>, expected: f64, measured: f64, within: f64) -> Figure {
        let method = self.method.to_owned();
        let error = off(measured, expected);
        Figure { method, what: what.into(), expected, measured, error, within }
    }

    /// The values of a channel, in the pixels that count.
    fn values(&self, channel: usize) -> impl Iterator<Item = f64> {
        cut(self.image, self.region).map(move |pixel| f64::from(pixel[channel]))
    }

    /// Whether there are pixels that count, all of them finite.
    fn is_sound(&self) -> bool {
        let finite = |pixel: &[f32; 3]| pixel.iter().all(|value| value.is_finite());
        self.values(0).next().is_some() && cut(self.image, self.region).all(finite)
    }

    /// What is measured of a channel's values, in a figure of the channel that is off most.
    fn worst(
        &self,
        what: &str,
        expected: [f64; 3],
        within: f64,
        measure: impl Fn(&mut dyn Iterator<Item = f64>, f64) -> f64,
    ) -> Figure {
        if !self.is_sound() {
            return self.figure(what, expected[0], f64::NAN, within);
        }
        let figure = |c: usize| {
            self.figure(what, expected[c], measure(&mut self.values(c), expected[c]), within)
        };
        let worse = |a: Figure, b: Figure| if b.error > a.error { b } else { a };
        worse(worse(figure(0), figure(1)), figure(2))
    }

    fn mean(&self, what: &str, expected: [f64; 3], within: f64) -> Figure {
        self.worst(what, expected, within, |values, _| mean(values))
    }

    fn every_pixel(&self, expected: [f64; 3], within: f64) -> Figure {
        self.worst("worst pixel", expected, within, |values, expected| {
            let worse = |a: f64, b: f64| if off(b, expected) > off(a, expected) { b } else { a };
            values.reduce(worse).unwrap_or(f64::NAN)
        })
    }

    fn every_tile(&self, expected: [f64; 3], within: f64) -> Figure {
        let size = [self.image.width, self.image.height].map(|extent| extent.div_ceil(TILE));
        let part = |at: u32, extent: u32| {
            [at, at + 1].map(|edge| f64::from(edge * TILE) / f64::from(extent))
        };
        let tiles = (0..size[0] * size[1]).map(|index| {
            let [left, right] = part(index % size[0], self.image.width);
            let [top, bottom] = part(index / size[0], self.image.height);
            let tile = Seen { region: Some([left, top, right, bottom]), ..*self };
            tile.worst("worst tile", expected, within, |values, _| mean(values))
        });
        // What is no number is worse than all.
        let worse =
            |a: Figure, b: Figure| if a.error.is_nan() || a.error > b.error { a } else { b };
        tiles
            .reduce(worse)
            .unwrap_or_else(|| self.figure("worst tile", expected[0], f64::NAN, within))
    }

    fn black(&self) -> Figure {
        self.worst("brightest pixel", [0.0; 3], 0.0, |values, _| {
            values.fold(0.0, |most, value| f64::max(most, value.abs()))
        })
    }

    fn finite(&self) -> Figure {
        let broken = |pixel: &&[f32; 3]| !pixel.iter().all(|value| value.is_finite());
        let count = cut(self.image, self.region).filter(broken).count();
        self.figure("pixels that are not finite", 0.0, count as f64, 0.0)
    }

    fn like(&self, like: &Like, other: &Image) -> Vec<Figure> {
        let turned;
        let other = if like.mirrored {
            turned = mirrored(other);
            &turned
        } else {
            other
        };
        let limits = [("ꟻLIP", like.flip), ("mean", like.mean), ("largest difference", like.pixel)];
        let limits = limits.into_iter().filter_map(|(what, within)| Some((what, within?)));
        let measure = |what, within| {
            let figure = self.likeness(what, other, within);
            figure.unwrap_or_else(|| self.figure(what, 0.0, f64::NAN, within))
        };
        limits.map(|(what, within)| measure(what, within)).collect()
    }

    /// One of the figures of likeness; none if one of the images has no sound pixel, or the other is
    /// black: two renders that both fail would be alike.
    fn likeness(&self, what: &str, other: &Image, within: f64) -> Option<Figure> {
        let others = Seen { image: other, ..*self };
        let sizes = [self.image, other].map(|image| [image.width, image.height]);
        if !self.is_sound() || !others.is_sound() || sizes[0] != sizes[1] {
            return None;
        }
        let means = [0, 1, 2].map(|channel| mean(others.values(channel)));
        let brightness = means.iter().sum::<f64>() / 3.0;
        if brightness <= 0.0 {
            return None;
        }
        Some(match what {
            "mean" => self.mean("mean, that of the other", means, within),
            "ꟻLIP" => {
                let keep = vec![true; other.pixels.len()];
                // Middle grey, so that dark and bright scenes are looked at alike.
                let exposure = (0.2 / brightness).log2();
                let found = Comparison::of(other, self.image, &keep, exposure as f32)?;
                self.figure("ꟻLIP to the other", 0.0, found.flip, within)
            }
            _ => {
                let far = |c: usize| self.values(c).zip(others.values(c));
                let pairs = (0..3).flat_map(far);
                let most = largest(pairs.map(|(a, b)| (a - b).abs())) / brightness;
                self.figure("largest difference over the other's mean", 0.0, most, within)
            }
        })
    }
}

/// How far a value is off: relative to what is expected, if that is not 0.
fn off(value: f64, expected: f64) -> f64 {
    let difference = (value - expected).abs();
    if expected == 0.0 { difference } else { difference / expected.abs() }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

/// The pixels whose centres lie in a region.
fn cut(image: &Image, region: Option<[f64; 4]>) -> impl Iterator<Item = &[f32; 3]> {
    let [left, top, right, bottom] = region.unwrap_or([0.0, 0.0, 1.0, 1.0]);
    let size = [image.width, image.height].map(f64::from);
    let width = image.width.max(1) as usize;
    let inside = move |index: usize| {
        let x = ((index % width) as f64 + 0.5) / size[0];
        let y = ((index / width) as f64 + 0.5) / size[1];
        (left..right).contains(&x) && (top..bottom).contains(&y)
    };
    let pixels = image.pixels.iter().enumerate();
    pixels.filter(move |(index, _)| inside(*index)).map(|(_, pixel)| pixel)
}

fn mirrored(image: &Image) -> Image {
    let mut mirrored = image.clone();
    for row in mirrored.pixels.chunks_mut(image.width.max(1) as usize) {
        row.reverse();
    }
    mirrored
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extremes::cases::Radiance;

    fn image(pixels: [[f32; 3]; 4]) -> Image {
        Image { width: 2, height: 2, pixels: pixels.to_vec() }
    }

    fn holds(expect: &Expect, within: f64, image: &Image, other: Option<&Image>) -> bool {
        let seen = Seen { image, method: "vpl", region: None };
        let figures = judge(expect, within, seen, other);
        assert!(!figures.is_empty());
        figures.iter().all(Figure::holds)
    }

    #[test]
    fn each_kind_of_expectation_catches_what_is_off() {
        let plain = image([[1.0, 2.0, 4.0]; 4]);
        let with = |at: usize, channel: usize, value: f32| {
            let mut image = plain.clone();
            image.pixels[at][channel] = value;
            image
        };
        let color = Radiance::Color([1.0, 2.0, 4.0]);
        let off = with(3, 2, 4.04);
        assert!(holds(&Expect::Mean(color), 1e-9, &plain, None));
        assert!(holds(&Expect::Mean(color), 3e-3, &off, None));
        assert!(!holds(&Expect::Mean(color), 2e-3, &off, None));
        assert!(holds(&Expect::EveryPixel(color), 0.011, &off, None));
        assert!(!holds(&Expect::EveryPixel(color), 9e-3, &off, None));
        assert!(holds(&Expect::EveryTile(color), 3e-3, &off, None));
        assert!(!holds(&Expect::EveryTile(color), 2e-3, &off, None));
        let black = image([[0.0; 3]; 4]);
        let mut speck = black.clone();
        speck.pixels[1][2] = 1e-30;
        assert!(holds(&Expect::Black, 0.0, &black, None));
        assert!(!holds(&Expect::Black, 1.0, &speck, None));
        for like in [
            Like { pixel: Some(9e-3), ..Like::default() },
            Like { mean: Some(2e-3), ..Like::default() },
            Like { flip: Some(1e-6), ..Like::default() },
        ] {
            let like = Expect::Like(like);
            assert!(holds(&like, 0.0, &plain, Some(&plain)));
            assert!(!holds(&like, 0.0, &off, Some(&plain)), "{like:?}");
            assert!(!holds(&like, 0.0, &plain, None));
        }
        assert!(!holds(&Expect::Refused("x".to_owned()), 0.0, &plain, None));
    }

    #[test]
    fn what_is_not_finite_is_never_right() {
        let one = Radiance::Grey(1.0);
        let like = Like { flip: Some(1e9), mean: Some(1e9), pixel: Some(1e9), ..Like::default() };
        let good = image([[1.0; 3]; 4]);
        for value in [f32::NAN, f32::INFINITY] {
            let mut bad = good.clone();
            bad.pixels[2][1] = value;
            let kinds = [
                Expect::Mean(one),
                Expect::EveryPixel(one),
                Expect::EveryTile(one),
                Expect::Finite,
                Expect::Like(like.clone()),
            ];
            for expect in kinds {
                assert!(holds(&expect, 1e9, &good, Some(&good)), "{expect:?}");
                assert!(!holds(&expect, 1e9, &bad, Some(&good)), "{expect:?}");
            }
        }
    }

    #[test]
    fn what_is_not_finite_is_not_black() {
        for value in [f32::NAN, f32::INFINITY] {
            let mut bad = image([[0.0; 3]; 4]);
            bad.pixels[2][1] = value;
            assert!(!holds(&Expect::Black, 0.0, &bad, None));
        }
    }

    #[test]
    fn a_tile_that_is_not_finite_is_the_worst_wherever_it_is() {
        for bad in [0, 20] {
            let mut wide = Image { width: 32, height: 16, pixels: vec![[1.0; 3]; 512] };
            wide.pixels[bad][0] = f32::NAN;
            assert!(!holds(&Expect::EveryTile(Radiance::Grey(1.0)), 0.5, &wide, None), "{bad}");
        }
    }

    #[test]
    fn nothing_is_like_a_black_image() {
        let black = image([[0.0; 3]; 4]);
        for like in [
            Like { pixel: Some(1.0), ..Like::default() },
            Like { mean: Some(1.0), ..Like::default() },
            Like { flip: Some(1.0), ..Like::default() },
        ] {
            assert!(!holds(&Expect::Like(like), 0.0, &black, Some(&black)));
        }
    }

    #[test]
    fn a_region_counts_alone_and_an_image_is_mirrored() {
        let seen = |image, region| Seen { image, method: "", region };
        let image = image([[1.0; 3], [0.0; 3], [1.0; 3], [0.0; 3]]);
        let [left, right] = [[0.0, 0.0, 0.5, 1.0], [0.5, 0.0, 1.0, 1.0]].map(Some);
        let of = |region| judge(&Expect::Black, 0.0, seen(&image, region), None)[0].holds();
        assert_eq!((of(left), of(right)), (false, true));
        // A region without a pixel shows nothing.
        assert!(!of(Some([0.3, 0.3, 0.4, 0.4])));
        let like = |mirrored| {
            let like = Like { pixel: Some(0.0), mirrored, ..Like::default() };
            judge(&Expect::Like(like), 0.0, seen(&image, None), Some(&image))[0].holds()
        };
        assert_eq!((like(false), like(true)), (true, false));
        let turned = mirrored(&image);
        assert_eq!(mirrored(&turned), image);
        assert_eq!(turned.pixels[0], [0.0; 3]);
    }
}
