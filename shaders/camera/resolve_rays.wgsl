// The mean of what the first rays of a pixel see to the film, and its range for the pixels around.

@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;
@group(0) @binding(105) var<storage, read> meetings: array<u32>;
// Their sum.
@group(0) @binding(110) var<storage, read_write> ray_sums: array<vec4f>;
// In the order of pixels, the least and the most that a ray sees, and where surfaces meet.
@group(0) @binding(111) var packed_ranges: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let tile = tile_pixels();
    let pixel = pixel_of(id.x, params.first_block, params.width);
    if pixel.x >= params.width || pixel.y >= params.height { return; }
    let first = first_radiance(tile, pixel, id.x);
    film[id.x] += vec4f(first.sum / f32(first_rays()), 0.0);
    ray_sums[id.x] = vec4f(first.sum, 0.0);
    let range = vec4u(pack_radiance(first.low), pack_radiance(first.high), meetings[id.x], 0u);
    textureStore(packed_ranges, table_place(place_of(tile, pixel)), range);
}
