// Parameters of the stages that find which rows (points) see which lights, and the points.

struct VisibilityParams {
    rows: u32,
    vpls: u32,
    first_word: u32,
    matrix_word: u32,
    offset: f32,
    nodes: u32,
    first: u32,
    count: u32,
    first_point: u32,
    words: u32,
    seed: u32,
    pad: u32,
}

@group(0) @binding(0) var<storage, read> params: VisibilityParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
