// Samples textures, for the test of that name.

// Texture coordinates and, as a number, the texture.
@group(0) @binding(3) var<storage, read> places: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> results: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&places) { return; }
    let place = places[id.x];
    results[id.x] = sample_texture(u32(place.z), place.xy);
}
