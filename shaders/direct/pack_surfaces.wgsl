// The surfaces of the visible points in the order of pixels.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(93) var packed_surfaces: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let at = place_of(vec2u(pixel_of(id.x, 0u, params.width)));
    let point = points[id.x];
    let packed = vec4u(bitcast<vec3u>(point.position), surface_code(point));
    textureStore(packed_surfaces, table_place(at), packed);
}
