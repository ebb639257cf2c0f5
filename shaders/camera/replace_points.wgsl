// Which pixels have their visible point on a surface that no point around shows, in place of their own,
// so that what is thinner than a pixel has light of its own. A pixel gives up its point only if a pixel
// around shows that surface and keeps its own.

@group(0) @binding(101) var pixel_surfaces: texture_2d<u32>;
@group(0) @binding(104) var<storage, read> unseen: array<u32>;
@group(0) @binding(108) var<storage, read_write> point_rays: array<u32>;

// Whether a pixel whose words `unseen_surfaces` left may have another point.
fn may_change(tile: TilePixels, pixel: vec2u, found: u32) -> bool {
    // Of two that want to, one of the fields of a chessboard goes first.
    let first = ((pixel.x + pixel.y) & 1u) == 0u;
    // What sees nothing has no point to give up.
    var kept = textureLoad(pixel_surfaces, table_place(place_of(tile, pixel)), 0).w == 0u;
    for (var i = 0u; i < pixels_around(); i++) {
        let stays = (unseen[place_of(tile, around(tile, pixel, i))] & 15u) == 0u || (first && (i & 1u) == 1u);
        kept = kept || (((found >> (4u + i)) & 1u) != 0u && stays);
    }
    return kept;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let tile = tile_pixels();
    let pixel = pixel_of(id.x, params.first_block, params.width);
    var ray = 0u;
    if pixel.x < params.width && pixel.y < params.height {
        let found = unseen[place_of(tile, pixel)];
        // A loop, as a branch that no invocation takes is not skipped everywhere.
        let rounds = select(0u, 1u, (found & 15u) != 0u);
        for (var round = 0u; round < rounds; round++) {
            if may_change(tile, pixel, found) { ray = found & 15u; }
        }
    }
    point_rays[id.x] = ray;
}
