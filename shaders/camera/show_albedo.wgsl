// The reflectance of the visible surfaces.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&film) { return; }
    let point = points[id.x];
    if point.surface == NOTHING { return; }
    film[id.x] += vec4f(reflectance_of(id.x, point), 0.0);
}
