// The reflectance of the visible surfaces.

@group(0) @binding(3) var<storage, read> materials: array<Material>;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&film) { return; }
    let surface = points[id.x].surface;
    if surface == NOTHING { return; }
    film[id.x] += vec4f(materials[surface & ~FRONT].albedo, 0.0);
}
