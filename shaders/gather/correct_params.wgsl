// Parameters and buffers of the stage that corrects shared visibility.

struct CorrectParams {
    points: u32,
    rows: u32,
    matrix_word: u32,
    words: u32,
    first_point: u32,
    // Of each point, for all chunks of the bit matrix.
    rays: u32,
    // The first of them in the sequence of its point.
    first_ray: u32,
    seed: u32,
    // Distance by which shadow rays are kept off surfaces.
    offset: f32,
    // Of the hierarchy.
    nodes: u32,
    // Which chunk of the bit matrix this is, and of how many.
    chunk: u32,
    chunks: u32,
}

@group(0) @binding(0) var<storage, read> params: CorrectParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(5) var<storage, read> vpls: array<Vpl>;
@group(0) @binding(6) var<storage, read> bits: array<u32>;
@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;
