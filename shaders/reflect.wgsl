// Radiance that the visible surfaces reflect of their irradiance: E albedo / pi.

@group(0) @binding(3) var<storage, read> materials: array<Material>;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(7) var<storage, read> irradiance: array<vec4f>;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&film) { return; }
    let surface = points[id.x].surface;
    if surface == NOTHING { return; }
    let albedo = materials[surface & ~FRONT].albedo;
    film[id.x] += vec4f(irradiance[id.x].rgb * albedo / PI, 0.0);
}
