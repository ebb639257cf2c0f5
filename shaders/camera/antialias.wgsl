// More camera rays where surfaces of unlike radiance meet. Each has the light of a visible point
// around on its surface, as light varies slowly along a surface, so that coverage alone needs the
// rays; emission and background are its own. The first rays of the pixels around tell where that is,
// and not the pixel's own: a mean over more samples where the first ones differ, and those among
// them, is biased (Kirk and Arvo, "Unbiased Sampling Techniques for Image Synthesis", 1991).

@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;
@group(0) @binding(107) var ranges: texture_2d<u32>;
@group(0) @binding(110) var<storage, read> ray_sums: array<vec4f>;

// Most beams of a pixel in one dispatch.
const MOST_BEAMS = 8u;
// How far the radiances around are apart, over their mean, to be worth more rays.
const CONTRAST = 0.25;

var<workgroup> beam_sums: array<vec3f, 512>;

// Whether surfaces of unlike radiance meet here, as the pixels around tell.
fn is_edge(tile: TilePixels, pixel: vec2u, own: u32) -> bool {
    var low = vec3f(HUGE);
    var high = vec3f(0.0);
    var meet = false;
    for (var i = 0u; i < pixels_around(); i++) {
        let other = around(tile, pixel, i);
        let range = textureLoad(ranges, table_place(place_of(tile, other)), 0);
        let is = any(other != pixel);
        low = select(low, min(low, unpack_radiance(range.x)), is);
        high = select(high, max(high, unpack_radiance(range.y)), is);
        meet = meet || (range.z & select(2u, 1u, i == OWN)) != 0u;
    }
    let apart = high - low;
    let mean = 0.5 * (high + low);
    let most = max(apart.x, max(apart.y, apart.z));
    let differ = most > CONTRAST * max(mean.x, max(mean.y, mean.z));
    return stored_throughput(own).w > 0.0 || (meet && differ);
}

// The sum of what the rays of a beam see, those of them that are wanted.
fn beam_sum(tile: TilePixels, own: u32, first: u32, end: u32, invocation: u32) -> vec3f {
    let pixel = pixel_of(own, params.first_block, params.width);
    let stream = ray_stream(pixel);
    let beam = pixel_beam(pixel, stream, first, end);
    let hits = traverse_beam(params.position, beam, params.nodes, invocation);
    var surfaces: array<vec4u, 4>;
    var throughputs: array<vec3f, 4>;
    var sum = vec3f(0.0);
    // No constant: see `pixels_around`.
    let rays = select(min(end - first, BEAM_RAYS), 0u, first >= end);
    for (var i = 0u; i < rays; i++) {
        let direction = beam_direction(beam, i);
        let chain = specular_chain_from(
            with_weights(beam_hit(hits, i), params.position, direction), direction, beam.limits[i], params.nodes, params.offset,
            ray_number(first + i), stream, invocation,
        );
        let point = hit_point(chain.hit, chain.direction);
        let is = beam.limits[i] > 0.0;
        surfaces[i] = pack_surface(point);
        throughputs[i] = select(vec3f(0.0), throughput_of(chain), is);
        let width = ray_spread(direction) * length_of(chain);
        let light = seen_without_light(chain.hit, point, chain.direction, width);
        sum += select(vec3f(0.0), light * throughput_of(chain), is);
    }
    let codes = linked(tile, pixel, RaySurfaces(
        unpack_surface(surfaces[0]),
        unpack_surface(surfaces[1]),
        unpack_surface(surfaces[2]),
        unpack_surface(surfaces[3]),
    ));
    for (var i = 0u; i < rays; i++) {
        if codes[i] != NO_LIGHT {
            sum += radiance[point_at(tile, around(tile, pixel, codes[i]))].rgb * throughputs[i];
        }
    }
    return sum;
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
    var edge = id.x == own && pixel.x < params.width && pixel.y < params.height;
    if edge { edge = is_edge(tile, pixel, own); }
    let listed = list_points(edge, own, invocation);

    // The beams of all edges, one after the other: a subgroup has no idle lanes but the last.
    let beams = min((params.rays + BEAM_RAYS - 1u) / BEAM_RAYS, MOST_BEAMS);
    let all = listed.count * beams;
    let end = params.first_ray + params.rays;
    for (var start = 0u; start < all; start += 64u) {
        let beam = min(start + invocation, all - 1u);
        let ray = params.first_ray + BEAM_RAYS * (beam % beams);
        let last = select(0u, end, start + invocation < all);
        // A loop: subgroups without beams are done.
        let rounds = select(0u, 1u, some_ray(last != 0u));
        for (var round = 0u; round < rounds; round++) {
            let sum = beam_sum(tile, listed_points[beam / beams], ray, last, invocation);
            if last != 0u { beam_sums[beam] = sum; }
        }
    }
    workgroupBarrier();

    if edge {
        var sum = vec3f(0.0);
        for (var beam = 0u; beam < beams; beam++) {
            sum += beam_sums[listed.rank * beams + beam];
        }
        let first = first_rays();
        // The film has the mean of the first rays, which now are some among more.
        if params.first_ray == first {
            let excess = f32(params.edge_rays - first) / f32(first);
            sum -= ray_sums[own].rgb * excess;
        }
        film[own] += vec4f(sum / f32(params.edge_rays), 0.0);
    }
}
