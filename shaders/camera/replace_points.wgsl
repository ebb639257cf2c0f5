// Visible points on surfaces that no point around shows, in place of others, so that what is thinner
// than a pixel has light of its own. A pixel gives up its point only if a pixel around shows that
// surface and keeps its own.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(101) var<storage, read_write> pixel_surfaces: array<vec4u>;
@group(0) @binding(104) var<storage, read> unseen: array<u32>;

// Whether a pixel whose words `unseen_surfaces` left may have another point.
fn may_change(tile: TilePixels, pixel: vec2u, found: u32) -> bool {
    // Of two that want to, one of the fields of a chessboard goes first.
    let first = ((pixel.x + pixel.y) & 1u) == 0u;
    var kept = pixel_surfaces[place_of(tile, pixel)].w == 0u;
    for (var i = 0u; i < 9u; i++) {
        let stays = (unseen[place_of(tile, around(tile, pixel, i))] & 15u) == 0u || (first && (i & 1u) == 1u);
        kept = kept || (((found >> (4u + i)) & 1u) != 0u && stays);
    }
    return kept;
}

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let own = min(id.x, params.blocks * 64u - 1u);
    let tile = tile_pixels();
    let pixel = pixel_of(own, params.first_block, params.width);
    let is = id.x == own && pixel.x < params.width && pixel.y < params.height;
    var found = 0u;
    if is { found = unseen[place_of(tile, pixel)]; }
    let rounds = select(0u, 1u, some_ray((found & 15u) != 0u));
    for (var round = 0u; round < rounds; round++) {
        let changes = (found & 15u) != 0u && may_change(tile, pixel, found);
        let ray = max(found & 15u, 1u) - 1u;
        let stream = ray_stream(pixel);
        let direction = ray_direction(pixel, stream, ray);
        let chain = trace_specular_chain(
            params.position, direction, select(0.0, HUGE, changes), params.nodes, params.offset,
            ray_number(ray), stream, invocation,
        );
        if changes {
            let point = hit_point(chain.hit, chain.direction);
            let way = ray_offset(point, chain.direction, params.offset);
            points[own] = with_view_direction(point, way);
            pixel_surfaces[place_of(tile, pixel)] = pack_surface(point);
            let width = pixel_spread(direction) * length_of(chain);
            store_albedo(own, chain.hit, point, chain.direction, width);
            store_emission_scale(own, chain.hit, point, chain.direction, width);
            store_throughput(own, chain);
        }
    }
}
