// Parameters of the filter of direct light.

struct FilterParams {
    // Of the tile, in pixels.
    width: u32,
    height: u32,
    // Pixels between taps.
    step: u32,
    // By which the variance of a difference is multiplied for one that counts 1/e.
    tolerance: f32,
    // Light samples of a point that has many like neighbours.
    rays: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(0) var<storage, read> params: FilterParams;

// The place of a pixel in the order of pixels.
fn place_of(pixel: vec2u) -> u32 {
    return pixel.y * params.width + pixel.x;
}
