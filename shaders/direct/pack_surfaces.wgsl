// The surfaces of the visible points in the order of pixels.

@group(0) @binding(17) var<storage, read_write> surfaces: array<vec4u>;
@group(0) @binding(4) var<storage, read> points: array<Point>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let pixel = pixel_of(id.x, 0u, params.width);
    let point = points[id.x];
    surfaces[pixel.y * params.width + pixel.x] =
        vec4u(bitcast<vec3u>(point.position), surface_code(point));
}
