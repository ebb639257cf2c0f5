// The pixels around one, of those of a tile, which is whole rows of blocks.

// The pixel itself, of the 3 x 3 around it.
const OWN = 4u;

fn tile_width() -> u32 {
    return (params.width + 7u) & ~7u;
}

// The first row of the tile.
fn tile_row() -> u32 {
    return params.first_block / ((params.width + 7u) / 8u) * 8u;
}

// The place of a pixel in the order of the tile's pixels.
fn place_of(pixel: vec2u) -> u32 {
    return (pixel.y - tile_row()) * tile_width() + pixel.x;
}

// The i-th of the 3 x 3 pixels around one; itself where the tile has none.
fn around(pixel: vec2u, i: u32) -> vec2u {
    let other = vec2i(pixel) + vec2i(i32(i % 3u), i32(i / 3u)) - 1;
    let first = i32(tile_row());
    let rows = i32(params.blocks * 64u / tile_width());
    let end = vec2i(i32(params.width), min(first + rows, i32(params.height)));
    let is = all(other >= vec2i(0, first)) && all(other < end);
    return select(pixel, vec2u(other), is);
}

// The point of a pixel.
fn point_at(pixel: vec2u) -> u32 {
    return point_of(pixel - vec2u(0u, tile_row()), params.width);
}
