// Bias compensation starts at the visible points of a tile: some paths at each, side by side.

struct StartParams {
    points: u32,
    first_block: u32,
    seed: u32,
    // Of each point.
    paths: u32,
}

@group(0) @binding(0) var<storage, read> params: StartParams;
@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(24) var<storage, read_write> survivors: array<u32>;
@group(0) @binding(30) var<storage, read> visible: array<Point>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points * params.paths { return; }
    let index = id.x / params.paths;
    let point = visible[index];
    points[id.x] = point;
    paths[id.x] = Path(vec3f(1.0), hash(hash(params.first_block * 64u + index) + params.seed));
    survivors[id.x] = select(id.x, NOTHING, point.surface == NOTHING);
}
