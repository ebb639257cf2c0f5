// Which pixels have a first ray that meets a surface of which no pixel around has a visible point,
// and which of those around see the surface of their own.

@group(0) @binding(103) var<storage, read> ray_codes: array<u32>;
// In the order of pixels: such a ray, plus one, in 4 bits, 0 if there is none; then a bit for each
// of the 3 x 3 pixels around.
@group(0) @binding(104) var<storage, read_write> unseen: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let tile = tile_pixels();
    let pixel = pixel_of(id.x, params.first_block, params.width);
    if pixel.x >= params.width || pixel.y >= params.height { return; }
    var found = 0u;
    // A loop, as a branch that no invocation takes is not skipped everywhere.
    let rounds = select(0u, 1u, ray_codes[id.x] == NOT_LINKED);
    for (var round = 0u; round < rounds; round++) {
        let own = surface_around(tile, pixel, OWN);
        let rays = stored_rays(id.x);
        let codes = vec4u(rays.s0.code, rays.s1.code, rays.s2.code, rays.s3.code);
        var shown = codes == vec4u(0u);
        for (var i = 0u; i < pixels_around(); i++) {
            let other = surface_around(tile, pixel, i);
            shown |= vec4<bool>(
                alike(rays.s0, other), alike(rays.s1, other),
                alike(rays.s2, other), alike(rays.s3, other),
            );
            let is_other = any(around(tile, pixel, i) != pixel);
            found |= select(0u, 16u << i, is_other && alike(own, other));
        }
        for (var ray = 4u; ray > 0u; ray--) {
            if !shown[ray - 1u] { found = (found & ~15u) | ray; }
        }
    }
    unseen[place_of(tile, pixel)] = found;
}
