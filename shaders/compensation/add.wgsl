// Adds what bias compensation gives back by the lobe that its paths began with to what the visible
// points gather, or have gathered of it alone: then with half the difference of the halves of the
// paths in w.

struct CompensatedParams {
    points: u32,
    // Of a path in the mean.
    share: f32,
    lobe: u32,
    // Of each point.
    paths: u32,
    // The number of the first.
    first: u32,
    // 1 if the difference of the halves of the paths is wanted, else 0.
    halves: f32,
    pad0: u32,
    pad1: u32,
}

@group(0) @binding(0) var<storage, read> params: CompensatedParams;
@group(0) @binding(29) var<storage, read_write> compensated: array<Gathered>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    var sum = vec3f(0.0);
    var difference = 0.0;
    let start = id.x * params.paths;
    for (var i = 0u; i < params.paths; i++) {
        let light = radiance[start + i].rgb;
        sum += light;
        // Of even and odd paths, half as many each.
        let odd = ((params.first + i) & 1u) != 0u;
        difference += (light.r + light.g + light.b) / select(3.0, -3.0, odd);
    }
    let given = vec4f(sum, difference * params.halves) * params.share;
    compensated[id.x] += gathered_by(params.lobe, given);
}
