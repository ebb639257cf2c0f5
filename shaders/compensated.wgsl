// Adds to the radiance of visible points what bias compensation gives back.

struct CompensatedParams {
    points: u32,
    // Of a path in the mean.
    share: f32,
    pad0: u32,
    pad1: u32,
}

@group(0) @binding(0) var<storage, read> params: CompensatedParams;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    film[id.x] += vec4f(radiance[id.x].rgb * params.share, 0.0);
}
