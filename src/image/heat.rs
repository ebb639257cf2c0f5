//! Values in false colours, above a bar that says what the colours mean.

pub use super::canvas::Canvas;
use super::label;

/// Colours at equal steps, between which they are mixed as sRGB.
pub type Ramp = [[u8; 3]];

/// Magma, by N. Smith and S. van der Walt (matplotlib, CC0), in steps of an eighth: from black
/// to pale yellow, its lightness in proportion to the value.
pub const SEQUENTIAL: &Ramp = &[
    [0, 0, 4],
    [28, 16, 68],
    [79, 18, 123],
    [129, 37, 129],
    [181, 54, 122],
    [229, 80, 100],
    [251, 135, 97],
    [254, 194, 135],
    [252, 253, 191],
];

/// Blue for what is below 0, white for 0, red above.
pub const DIVERGING: &Ramp =
    &[[0, 0, 96], [64, 104, 232], [255, 255, 255], [232, 72, 56], [96, 0, 0]];

/// What is left out of the map.
const MASKED: [u8; 3] = [96; 3];

/// What is not finite.
const NONFINITE: [u8; 3] = [0, 255, 0];

/// The range that the colours span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// From 0 to a value.
    Positive(f64),
    /// From minus a value to plus that.
    Signed(f64),
}

impl Range {
    /// The colour of a value; what lies outside has that of the nearer end.
    fn colour(self, value: f64) -> [u8; 3] {
        if !value.is_finite() {
            return NONFINITE;
        }
        match self {
            Self::Positive(scale) => mixed(SEQUENTIAL, value / scale),
            Self::Signed(scale) => mixed(DIVERGING, 0.5 + 0.5 * value / scale),
        }
    }

    fn ends(self) -> [f64; 2] {
        match self {
            Self::Positive(scale) => [0.0, scale],
            Self::Signed(scale) => [-scale, scale],
        }
    }
}

/// The colour at a place in [0, 1] of a ramp.
fn mixed(ramp: &Ramp, place: f64) -> [u8; 3] {
    let last = ramp.len() - 1;
    let place = place.clamp(0.0, 1.0) * last as f64;
    let index = (place as usize).min(last - 1);
    let part = place - index as f64;
    let mix = |from: u8, to: u8| f64::from(from) + part * (f64::from(to) - f64::from(from));
    let [from, to] = [ramp[index], ramp[index + 1]];
    [0, 1, 2].map(|channel| mix(from[channel], to[channel]).round() as u8)
}

/// The narrowest canvas, which two labels fit on.
const NARROWEST: usize = 96;

/// Draws a map of values, row by row, those not to keep in grey, what is not finite in green;
/// below it a bar of the colours and the values at its ends.
pub fn draw(size: [u32; 2], values: &[f32], keep: &[bool], range: Range) -> Canvas {
    let [width, height] = size.map(|extent| extent as usize);
    let dot = if width < 256 { 1 } else { 2 };
    let bar = 6 * dot;
    let wide = width.max(NARROWEST);
    let mut canvas = Canvas::black([wide, height + bar + (label::HEIGHT + 2) * dot]);
    for (index, (&value, &keep)) in values.iter().zip(keep).enumerate() {
        let colour = if keep { range.colour(f64::from(value)) } else { MASKED };
        canvas.fill([index % width, index / width], [1, 1], colour);
    }
    let [low, high] = range.ends();
    for x in 0..wide {
        let value = low + (high - low) * (x as f64 + 0.5) / wide as f64;
        canvas.fill([x, height], [1, bar], range.colour(value));
    }
    let [left, right] = [low, high].map(short);
    let top = height + bar + dot;
    label::draw(&mut canvas, [dot, top], &left, dot);
    let from = wide.saturating_sub(label::width(&right, dot) + dot);
    label::draw(&mut canvas, [from, top], &right, dot);
    canvas
}

/// A number in at most ten characters.
fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        0.001..1000.0 => {
            format!("{value:.4}").trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_follow_values() {
        let positive = Range::Positive(2.0);
        assert_eq!([0.0, -1.0].map(|value| positive.colour(value)), [[0, 0, 4]; 2]);
        assert_eq!([2.0, 9.0].map(|value| positive.colour(value)), [[252, 253, 191]; 2]);
        assert_eq!(positive.colour(1.0), [181, 54, 122]);
        let signed = Range::Signed(2.0);
        assert_eq!(signed.colour(0.0), [255; 3]);
        assert_eq!([-2.0, 2.0].map(|value| signed.colour(value)), [[0, 0, 96], [96, 0, 0]]);
        assert_eq!(signed.colour(f64::NAN), NONFINITE);
    }

    #[test]
    fn the_map_stands_above_its_scale() {
        let canvas = draw([2, 1], &[0.0, 1.0], &[true, false], Range::Positive(1.0));
        assert_eq!(canvas.size, [96, 14]);
        assert_eq!(canvas.bytes[..9], [0, 0, 4, 96, 96, 96, 0, 0, 0]);
        let row = |y: usize| &canvas.bytes[y * 96 * 3..][..96 * 3];
        assert_eq!(row(1)[..3], Range::Positive(1.0).colour(0.5 / 96.0));
        // The labels, 0 and 1, in white.
        assert_eq!(row(8)[3..12], [255; 9]);
        assert_eq!(row(12)[92 * 3..95 * 3], [255; 9]);
        let large = draw([300, 300], &[0.5; 90_000], &[true; 90_000], Range::Signed(1e-9));
        assert_eq!(large.size, [300, 326]);
    }

    #[test]
    fn labels_are_short() {
        let labels = [(0.0, "0"), (-0.25, "-0.25"), (120.0, "120"), (1e-9, "1.00e-9")];
        assert!(labels.iter().all(|(value, label)| short(*value) == *label));
        assert!(short(-999.999_99).len() <= 10 && short(-1.5e-300).len() <= 10);
    }
}
