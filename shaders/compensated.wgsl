// Adds what bias compensation gives back by the lobe that its paths began with to what the visible
// points gather.

struct CompensatedParams {
    points: u32,
    // Of a path in the mean.
    share: f32,
    lobe: u32,
    pad: u32,
}

@group(0) @binding(0) var<storage, read> params: CompensatedParams;
@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    let given = vec4f(radiance[id.x].rgb * params.share, 0.0);
    irradiance[id.x] += gathered_by(params.lobe, given);
}
