// The light of the visible points in the order of pixels, and what the filter compares of it.

@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;
// Its mean and half the difference of the halves of the light samples.
@group(0) @binding(96) var packed_means: texture_storage_2d<rg32uint, write>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let at = place_of(vec2u(pixel_of(id.x, 0u, params.width)));
    let light = irradiance[id.x];
    store_light(id.x, at, light);
    let compared = bitcast<vec2u>(mean_and_difference(light));
    textureStore(packed_means, table_place(at), vec4u(compared, 0u, 0u));
}
