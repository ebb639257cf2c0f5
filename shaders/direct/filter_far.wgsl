// The taps of a level that are further away than the 5 x 5 pixels around.

// A bit for each of the 3 x 3 taps that sees the same surface, row by row.
fn like_taps(point: u32, pixel: vec2i) -> u32 {
    let own = surface_at(pixel);
    var taps = 0u;
    for (var i = 0; i < 9; i++) {
        let other = pixel + vec2i(i % 3 - 1, i / 3 - 1) * i32(params.step);
        taps |= u32(is_like(own, surface_at(other))) << u32(i);
    }
    return taps;
}
