// The distance from the camera, in normalised units.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&film) { return; }
    if points[id.x].surface == NOTHING { return; }
    film[id.x] += vec4f(vec3f(points[id.x].depth), 0.0);
}
