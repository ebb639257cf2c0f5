// The mean of what the first rays of a pixel see to the film, and its range for the pixels around.

@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;
@group(0) @binding(107) var<storage, read_write> ranges: array<vec2u>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let tile = tile_pixels();
    let pixel = pixel_of(id.x, params.first_block, params.width);
    if pixel.x >= params.width || pixel.y >= params.height { return; }
    let first = first_radiance(tile, pixel, id.x);
    film[id.x] += vec4f(first.sum / f32(first_rays()), 0.0);
    ranges[place_of(tile, pixel)] = vec2u(pack_radiance(first.low), pack_radiance(first.high));
}
