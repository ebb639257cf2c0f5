// The first rays of every pixel of a tile. Of each is kept what it meets, and the light that it sees
// without any visible point's help.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(109) var packed_pixel_surfaces: texture_storage_2d<rgba32uint, write>;
@group(0) @binding(102) var<storage, read_write> ray_surfaces: array<vec4u>;
@group(0) @binding(103) var<storage, read_write> ray_codes: array<u32>;

// No invocation returns early: a subgroup traces its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let own = min(id.x, params.blocks * 64u - 1u);
    let tile = tile_pixels();
    let pixel = pixel_of(own, params.first_block, params.width);
    let is = id.x == own && pixel.x < params.width && pixel.y < params.height;
    let rays = first_rays();
    let stream = ray_stream(pixel);
    let beam = pixel_beam(pixel, stream, 0u, select(0u, rays, is));
    let hits = traverse_beam(params.position, beam, params.nodes, invocation);
    let packed = pack_surface(points[own]);
    let surface = unpack_surface(packed);
    var alone = true;
    var emitted = no_emission();
    for (var i = 0u; i < rays; i++) {
        let direction = beam_direction(beam, i);
        let chain = specular_chain_from(
            with_weights(beam_hit(hits, i), params.position, direction), direction, beam.limits[i], params.nodes, params.offset,
            ray_number(i), stream, invocation,
        );
        let point = hit_point(chain.hit, chain.direction);
        let seen = pack_surface(point);
        alone = alone && alike(unpack_surface(seen), surface);
        if is { ray_surfaces[MOST_FIRST * own + i] = seen; }
        let width = ray_spread(direction) * length_of(chain);
        let light = seen_without_light(chain.hit, point, chain.direction, width);
        emitted = with_emission(emitted, light * throughput_of(chain));
        if is { store_ray_throughput(own, i, throughput_of(chain)); }
    }
    if is {
        textureStore(packed_pixel_surfaces, table_place(place_of(tile, pixel)), packed);
        ray_codes[own] = select(NOT_LINKED, ALL_OWN, alone);
        store_ray_emission(own, emitted);
    }
}
