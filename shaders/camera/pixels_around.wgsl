// The pixels around one, of those of a tile, which is whole rows of blocks.

// The pixel itself, of the 3 x 3 around it.
const OWN = 4u;

struct TilePixels {
    // A row of pixels, and the first one.
    width: u32,
    row: u32,
    // Where the tile, and the image, begins and ends.
    begin: vec2i,
    end: vec2i,
}

fn tile_pixels() -> TilePixels {
    let across = (params.width + 7u) / 8u;
    let row = params.first_block / across * 8u;
    let end = min(row + params.blocks / across * 8u, params.height);
    return TilePixels(8u * across, row, vec2i(0, i32(row)), vec2i(i32(params.width), i32(end)));
}

// How many pixels are around one, with itself. No constant, as drivers unroll loops whose length they
// know, and compile for longer than such a loop saves.
fn pixels_around() -> u32 {
    return select(9u, 0u, params.blocks == 0u);
}

// The place of a pixel in the order of the tile's pixels.
fn place_of(tile: TilePixels, pixel: vec2u) -> u32 {
    return (pixel.y - tile.row) * tile.width + pixel.x;
}

// The i-th of the 3 x 3 pixels around one; itself where the tile has none.
fn around(tile: TilePixels, pixel: vec2u, i: u32) -> vec2u {
    let other = vec2i(pixel) + vec2i(i32(i % 3u), i32(i / 3u)) - 1;
    let is = all(other >= tile.begin) && all(other < tile.end);
    return select(pixel, vec2u(other), is);
}

// The point of a pixel.
fn point_at(tile: TilePixels, pixel: vec2u) -> u32 {
    return point_of(pixel - vec2u(0u, tile.row), tile.width);
}
