// How much of the reflected indirect light the clamp took: reflected and removed radiance,
// means of the channels, summed over a pixel's samples.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(7) var<storage, read> irradiance: array<vec4f>;
@group(0) @binding(11) var<storage, read_write> energy: array<vec2f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&energy) { return; }
    let point = points[id.x];
    if point.surface == NOTHING { return; }
    let albedo = albedo_of(id.x, point);
    let e = irradiance[id.x];
    let mean = (e.r + e.g + e.b) / 3.0;
    let reflected = dot(e.rgb, albedo) / (3.0 * PI);
    // The removed light is reflected as the light that is kept at the same point.
    let plain = (albedo.r + albedo.g + albedo.b) / (3.0 * PI);
    let reflectance = select(plain, reflected / mean, mean > 0.0);
    energy[id.x] += vec2f(reflected, e.w * reflectance);
}
