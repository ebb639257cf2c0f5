// Samples textures over parallelograms, for the test of that name.

// Texture coordinates and, as a number, the texture; then the sides.
@group(0) @binding(3) var<storage, read> places: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> results: array<vec4f>;
@group(0) @binding(5) var<storage, read> sides: array<vec4f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&places) { return; }
    let place = places[id.x];
    let seen = sample_texture_over(u32(place.z), place.xy, sides[id.x].xy, sides[id.x].zw);
    results[id.x] = vec4f(seen, 1.0);
}
