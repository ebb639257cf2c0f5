// How much of the reflected indirect light the clamp took: reflected and removed radiance,
// means of the channels, summed over a pixel's samples.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(7) var<storage, read> irradiance: array<Gathered>;
@group(0) @binding(11) var<storage, read_write> energy: array<vec2f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&energy) { return; }
    let point = points[id.x];
    if point.surface == NOTHING { return; }
    let albedo = albedo_of(id.x, point);
    let light = without_compensation(id.x, irradiance[id.x]);
    energy[id.x] += reflected_and_clamped(point, albedo, light);
}
