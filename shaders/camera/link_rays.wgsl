// Which visible point gives its light to each of the first rays of a pixel.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(100) var<storage, read_write> ray_emission: array<vec4u>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let pixel = pixel_of(id.x, params.first_block, params.width);
    if pixel.x >= params.width || pixel.y >= params.height { return; }
    let point = points[id.x];
    let rays = first_rays();
    var codes = 0u;
    for (var ray = 0u; ray < rays; ray++) {
        codes |= nearest_around(pixel, id.x, point, stored_ray(id.x, ray)) << (8u * ray);
    }
    ray_emission[id.x].w = codes;
}
