// Adds what bias compensation gives back by the lobe that its paths began with to what the visible
// points gather.

struct CompensatedParams {
    points: u32,
    // Of a path in the mean.
    share: f32,
    lobe: u32,
    // Of each point.
    paths: u32,
}

@group(0) @binding(0) var<storage, read> params: CompensatedParams;
@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    var sum = vec3f(0.0);
    let first = id.x * params.paths;
    for (var path = first; path < first + params.paths; path++) { sum += radiance[path].rgb; }
    irradiance[id.x] += gathered_by(params.lobe, vec4f(sum * params.share, 0.0));
}
