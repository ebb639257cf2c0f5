// Parameters and buffers of shading, the stage that adds up, at every point, the irradiance from
// the VPLs that its row sees.

struct ShadeParams {
    points: u32,
    rows: u32,
    matrix_word: u32,
    words: u32,
    first_point: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(0) var<storage, read> params: ShadeParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(5) var<storage, read> vpls: array<Vpl>;
@group(0) @binding(6) var<storage, read> bits: array<u32>;
// In w, the mean of the channels that the bound took.
@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;
