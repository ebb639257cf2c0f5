// Mean and spread of the samples of each pixel.

struct PathSum {
    mean: vec3f,
    shadow_rays: f32,
    // Of the deviations from the mean.
    squares: vec3f,
    pad: f32,
}

@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;
@group(0) @binding(27) var<storage, read_write> sums: array<PathSum>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.paths { return; }
    let first = id.x * params.samples;
    var sum = vec4f(0.0);
    for (var i = first; i < first + params.samples; i++) { sum += radiance[i]; }
    let mean = sum.rgb / f32(params.samples);
    var squares = vec3f(0.0);
    for (var i = first; i < first + params.samples; i++) {
        let deviation = radiance[i].rgb - mean;
        squares += deviation * deviation;
    }
    sums[id.x] = PathSum(mean, sum.w, squares, 0.0);
}
