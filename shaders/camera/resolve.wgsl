// Adds the radiance of the visible points of a sample to the film, times the throughput of the
// specular chain through which the camera sees them.

@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&film) { return; }
    film[id.x] += vec4f(radiance[id.x].rgb * stored_throughput(id.x).rgb, 0.0);
}
