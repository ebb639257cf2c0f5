// Irradiance from the order of subsets into rows of pixels, and beside it what tells whether two
// pixels see the same surface in the same light: position, and in one word normal, lobe and
// signature.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(7) var<storage, read> irradiance: array<Gathered>;
@group(0) @binding(93) var packed_surfaces: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let s = params.s;
    let pixel = vec2u(id.x % params.width, id.x / params.width);
    let place = pixel % vec2u(s);
    let subset = (place.x + s * place.y + params.rotation) % (s * s);
    let from_point = subset * params.subset_points + point_of(pixel / vec2u(s), params.subset_width);
    let index = point_of(pixel, params.width);
    store_light(index, id.x, with_compensation(index, irradiance[from_point]));
    let point = points[index];
    let code = surface_code(point) | (signature_of(index) << 24u);
    textureStore(packed_surfaces, table_place(id.x), vec4u(bitcast<vec3u>(point.position), code));
}
