// Bias compensation starts at the visible points of a tile: a path at each.

struct StartParams {
    points: u32,
    first_block: u32,
    seed: u32,
    pad: u32,
}

@group(0) @binding(0) var<storage, read> params: StartParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(24) var<storage, read_write> survivors: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    let stream = hash(hash(params.first_block * 64u + id.x) + params.seed);
    paths[id.x] = Path(vec3f(1.0), stream);
    survivors[id.x] = select(id.x, NOTHING, points[id.x].surface == NOTHING);
}
