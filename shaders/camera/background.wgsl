// The radiance of the environment where nothing else is seen.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&film) { return; }
    let point = points[id.x];
    if point.surface != NOTHING { return; }
    film[id.x] += vec4f(background(point.normal) * stored_throughput(id.x).rgb, 0.0);
}
