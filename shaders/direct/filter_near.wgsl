// The taps of a level that are among the 5 x 5 pixels around.

@group(0) @binding(17) var<storage, read> like_pixels: array<u32>;

// A bit for each of the 3 x 3 taps that sees the same surface, row by row.
fn like_taps(point: u32, pixel: vec2i) -> u32 {
    let like = like_pixels[point];
    var taps = 0u;
    for (var i = 0u; i < 9u; i++) {
        let column = 2u + (i % 3u) * params.step - params.step;
        let row = 2u + (i / 3u) * params.step - params.step;
        taps |= ((like >> (5u * row + column)) & 1u) << i;
    }
    return taps;
}
