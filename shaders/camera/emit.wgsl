// Radiance that the visible surfaces emit towards the camera.

@group(0) @binding(3) var<storage, read> materials: array<Material>;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&film) { return; }
    let surface = points[id.x].surface;
    if surface == NOTHING { return; }
    let material = materials[surface & ~FRONT];
    if (surface & FRONT) != 0u || material.two_sided != 0u {
        let emitted = material.emission * emission_scale_of(id.x);
        film[id.x] += vec4f(emitted * stored_throughput(id.x).rgb, 0.0);
    }
}
