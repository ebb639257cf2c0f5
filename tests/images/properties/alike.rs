//! How alike two images are.

use gpu_vpl::image::Image;

/// How two images differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unlike {
    /// Pixels with other bits.
    pub bits: usize,
    /// The share of pixels off by more than a thousandth of themselves and of the mean.
    pub pixels: f64,
    /// The root mean square of the differences over the mean.
    pub spread: f64,
    /// The mean's difference over the mean.
    pub mean: f64,
}

pub fn compare(one: &Image, two: &Image) -> Unlike {
    assert_eq!((one.width, one.height), (two.width, two.height));
    let values = |image: &Image| -> Vec<f64> {
        image.pixels.iter().flatten().map(|&value| f64::from(value)).collect()
    };
    let (a, b) = (values(one), values(two));
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let level = mean(&b.iter().map(|value| value.abs()).collect::<Vec<_>>());
    assert!(level > 0.0, "a black image compares with everything");
    let off = |(a, b): &([f32; 3], [f32; 3])| {
        a.iter().zip(b).any(|(a, b)| f64::from((a - b).abs()) > 1e-3 * (f64::from(b.abs()) + level))
    };
    let pairs = || one.pixels.iter().copied().zip(two.pixels.iter().copied());
    let squares: Vec<f64> = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).collect();
    Unlike {
        spread: mean(&squares).sqrt() / level,
        bits: pairs().filter(|(a, b)| a.map(f32::to_bits) != b.map(f32::to_bits)).count(),
        pixels: pairs().filter(off).count() as f64 / one.pixels.len() as f64,
        mean: (mean(&a) - mean(&b)).abs() / level,
    }
}

/// The image seen in a mirror.
pub fn mirrored(image: &Image) -> Image {
    let rows = image.pixels.chunks(image.width as usize);
    let pixels = rows.flat_map(|row| row.iter().rev().copied()).collect();
    Image { pixels, ..image.clone() }
}

pub fn times(image: &Image, factor: f32) -> Image {
    let pixels = image.pixels.iter().map(|pixel| pixel.map(|value| value * factor)).collect();
    Image { pixels, ..image.clone() }
}
