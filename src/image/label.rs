//! Numbers drawn into an image: glyphs of 3 × 5 dots.

use super::canvas::Canvas;

/// Dots in a row and rows of a glyph, and from one glyph to the next.
const WIDTH: usize = 3;
pub const HEIGHT: usize = 5;
const ADVANCE: usize = WIDTH + 1;

/// The rows of a glyph from the top, a bit a dot, the leftmost highest. What has no glyph is
/// blank.
fn glyph(character: char) -> [u8; HEIGHT] {
    match character {
        '0' => [0b111, 0b101, 0b101, 0b101, 0b111],
        '1' => [0b010, 0b110, 0b010, 0b010, 0b111],
        '2' => [0b111, 0b001, 0b111, 0b100, 0b111],
        '3' => [0b111, 0b001, 0b011, 0b001, 0b111],
        '4' => [0b101, 0b101, 0b111, 0b001, 0b001],
        '5' => [0b111, 0b100, 0b111, 0b001, 0b111],
        '6' => [0b111, 0b100, 0b111, 0b101, 0b111],
        '7' => [0b111, 0b001, 0b010, 0b010, 0b010],
        '8' => [0b111, 0b101, 0b111, 0b101, 0b111],
        '9' => [0b111, 0b101, 0b111, 0b001, 0b111],
        '.' => [0b000, 0b000, 0b000, 0b000, 0b010],
        '-' => [0b000, 0b000, 0b111, 0b000, 0b000],
        '+' => [0b000, 0b010, 0b111, 0b010, 0b000],
        'e' => [0b000, 0b111, 0b110, 0b100, 0b111],
        _ => [0; HEIGHT],
    }
}

/// The width of a text in pixels, its dots being squares of that many.
pub fn width(text: &str, dot: usize) -> usize {
    (text.chars().count() * ADVANCE).saturating_sub(1) * dot
}

/// Draws a text with its upper left corner at a pixel.
pub fn draw(canvas: &mut Canvas, [left, top]: [usize; 2], text: &str, dot: usize) {
    for (index, character) in text.chars().enumerate() {
        for (row, bits) in glyph(character).into_iter().enumerate() {
            for column in (0..WIDTH).filter(|column| bits >> (WIDTH - 1 - column) & 1 == 1) {
                let corner = [left + (index * ADVANCE + column) * dot, top + row * dot];
                canvas.fill(corner, [dot, dot], [255; 3]);
            }
        }
    }
}
