// Which visible points give their light to the first rays of each pixel, and where surfaces meet.

@group(0) @binding(103) var<storage, read_write> ray_codes: array<u32>;
// Of each point, 1 if some pixel around sees another surface, and 2 if some ray of the
// pixel has another's light or sees some that is not reflected.
@group(0) @binding(105) var<storage, read_write> meetings: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let tile = tile_pixels();
    let pixel = pixel_of(id.x, params.first_block, params.width);
    if pixel.x >= params.width || pixel.y >= params.height { return; }
    let own = surface_around(tile, pixel, OWN);
    var meet = false;
    for (var i = 0u; i < pixels_around(); i++) { meet = meet || !alike(own, surface_around(tile, pixel, i)); }
    var codes = ray_codes[id.x];
    // A loop, as a branch that no invocation takes is not skipped everywhere.
    let rounds = select(0u, 1u, codes == NOT_LINKED);
    for (var round = 0u; round < rounds; round++) {
        let by_ray = linked(tile, pixel, stored_rays(id.x));
        codes = by_ray.x | (by_ray.y << 8u) | (by_ray.z << 16u) | (by_ray.w << 24u);
        ray_codes[id.x] = codes;
    }
    let alone = codes == ALL_OWN && stored_ray_emission(id.x).high <= 0.0;
    meetings[id.x] = select(0u, 1u, meet) | select(2u, 0u, alone);
}
