//! FLIP against figures of the authors' own implementation, and of what it sees.

#![expect(clippy::expect_used, reason = "a helper of tests fails by panicking")]

use gpu_vpl::image::Image;
use gpu_vpl::metrics::flip;

/// An image whose pixels are a function of column and row.
fn image([width, height]: [u32; 2], pixel: impl Fn(u32, u32) -> [f32; 3]) -> Image {
    let at = |index: u32| pixel(index % width, index / width);
    Image { width, height, pixels: (0..width * height).map(at).collect() }
}

/// FLIP's mean is what was found by flip-evaluator 1.7 (LDR, its default of 67 pixels a degree),
/// given clamp(2^EV · L) of the same images in sRGB as f32.
fn expect(pair: [Image; 2], exposure: f32, expected: f64) {
    let [reference, image] = pair;
    for [a, b] in [[&reference, &image], [&image, &reference]] {
        let mean = flip(a, b, exposure).expect("images of one size").mean;
        assert!((mean - expected).abs() < 2e-5, "{mean} instead of {expected}");
    }
}

/// Three numbers in [0, 1) for a pixel, by multiplicative hashing.
fn noise(seed: u32) -> impl Fn(u32, u32) -> [f32; 3] {
    move |x, y| {
        [0, 1, 2].map(|channel| {
            let mixed = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b);
            let mixed = (mixed ^ (3 * seed + channel)).wrapping_mul(0xc2b2_ae35);
            (mixed >> 24) as f32 / 256.0
        })
    }
}

#[test]
fn colours() {
    let size = [48, 40];
    let ramp = |x: u32, y: u32| [x as f32 / 64.0, y as f32 / 64.0, 0.25];
    let tinted = |x, y| {
        let [r, g, b] = ramp(x, y);
        [r, 0.75 * g, b + 0.125]
    };
    expect([image(size, ramp), image(size, tinted)], 0.0, 0.489_508);
}

#[test]
fn edges() {
    let stripes = |x: u32| [if (x / 3).is_multiple_of(2) { 0.75 } else { 0.125 }; 3];
    let shifted = |x, y| if y < 20 { stripes(x + 1) } else { stripes(x) };
    let size = [64, 40];
    expect([image(size, |x, _| stripes(x)), image(size, shifted)], 0.0, 0.188_369);
}

#[test]
fn noise_of_one_and_another_seed() {
    expect([1, 2].map(|seed| image([50, 50], noise(seed))), 0.0, 0.425_458);
}

#[test]
fn an_image_smaller_than_every_filter() {
    let dark = |x, y| if x == 0 { [0.0; 3] } else { noise(3)(x, y) };
    expect([image([5, 3], noise(3)), image([5, 3], dark)], 0.0, 0.508_372);
}

#[test]
fn light_beyond_white() {
    let light = |x: u32, y: u32| if x.abs_diff(20) + y.abs_diff(16) < 9 { 6.0 } else { 0.375 };
    let pair = [
        image([40, 32], |x, y| [light(x, y), 0.5 * light(x, y), 0.25]),
        image([40, 32], |x, y| [light(x + 2, y), 0.5 * light(x, y), 0.5]),
    ];
    expect(pair.clone(), 0.0, 0.484_162);
    expect(pair, -3.0, 0.221_050);
}

#[test]
fn one_changed_pixel_is_seen_where_it_is() {
    let grey = image([32, 24], |_, _| [0.5; 3]);
    let spot = image([32, 24], |x, y| if (x, y) == (20, 9) { [0.75; 3] } else { [0.5; 3] });
    let result = flip(&grey, &spot, 0.0).expect("images of one size");
    let largest = result.map.iter().copied().fold(0.0, f32::max);
    assert!(largest > 0.1 && result.map[9 * 32 + 20] == largest);
    assert!(result.map[0] < 1e-3, "far from it nothing is seen");
}
