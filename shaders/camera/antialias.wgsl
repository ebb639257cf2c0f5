// Radiance of pixels from camera rays: each takes the light of a visible point on its surface, as
// light varies slowly along a surface, so that coverage alone needs the rays; emission and
// background are its own. Where surfaces of unlike radiance meet, more rays follow the first ones.
// The first rays of the pixels around tell where that is, and not the pixel's own: a mean over more
// samples where the first ones differ, and those among them, is biased (Kirk and Arvo, "Unbiased
// Sampling Techniques for Image Synthesis", 1991).

@group(0) @binding(4) var<storage, read> points: array<Point>;
// In w, how many samples of the pixel hit something.
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;
@group(0) @binding(100) var<storage, read> ray_emission: array<vec4u>;
@group(0) @binding(101) var<storage, read> ray_highlights: array<vec4f>;

// Most rays of a pixel in one dispatch, a beam of four each.
const MOST_BEAMS = 8u;
// How far the radiances of an edge are apart, over their mean, to be worth more rays.
const CONTRAST = 0.25;

var<workgroup> beam_sums: array<vec3f, 512>;

// The light that a visible point reflects into a ray.
fn light_by_code(pixel: vec2u, own: u32, code: u32) -> vec3f {
    let light = radiance[around(pixel, own, select(code & 15u, OWN, code == NO_LIGHT))].rgb;
    return select(light, vec3f(0.0), code == NO_LIGHT);
}

// A first ray of a pixel around one, by which quadrant of those pixels it goes through: of 4 x 4
// quadrants, in rows, around the pixel itself.
struct RingRay {
    is: bool,
    pixel: vec2u,
    index: u32,
    ray: u32,
    // What gives it its light.
    code: u32,
    point: u32,
}

fn ring_ray(pixel: vec2u, own: u32, i: u32) -> RingRay {
    let cell = vec2u(i % 4u, i / 4u) + 1u;
    let way = vec2i(cell / 2u) - 1;
    let is = any(way != vec2i(0)) && in_tile(vec2i(pixel) + way);
    let other = select(pixel, vec2u(vec2i(pixel) + way), is);
    let index = point_at(vec2i(other));
    let ray = ((cell.x & 1u) + 2u * (cell.y & 1u)) % first_rays();
    let code = code_of(ray_emission[index].w, ray);
    let point = around(other, index, select(code & 15u, OWN, code == NO_LIGHT));
    return RingRay(is, other, index, ray, code, point);
}

// Whether more than one surface is seen around a pixel.
fn surfaces_meet(pixel: vec2u, own: u32) -> bool {
    var first: Point;
    var any = false;
    var differ = false;
    for (var i = 0u; i < 16u; i++) {
        let ring = ring_ray(pixel, own, i);
        if !ring.is { continue; }
        var seen = points[ring.point];
        if ring.code == NO_LIGHT { seen.surface = NOTHING; }
        if !any { first = seen; }
        any = true;
        differ = differ || ring.code >= UNLIKE || !alike(first, seen)
            || stored_throughput(ring.index).w > 0.0;
    }
    return differ;
}

// Whether the radiances around a pixel are so far apart that more rays are worth their time.
fn radiances_differ(pixel: vec2u, own: u32) -> bool {
    var low = vec3f(HUGE);
    var high = vec3f(0.0);
    var sum = vec3f(0.0);
    var count = 0.0;
    for (var i = 0u; i < 16u; i++) {
        let ring = ring_ray(pixel, own, i);
        if !ring.is { continue; }
        let light = select(radiance[ring.point].rgb, vec3f(0.0), ring.code == NO_LIGHT);
        let seen = light * ray_throughput(ring.index, ring.ray)
            + ray_highlights[ring.index][ring.ray];
        low = min(low, seen);
        high = max(high, seen);
        sum += seen;
        count += 1.0;
    }
    let apart = high - low;
    let most = max(apart.x, max(apart.y, apart.z));
    return most * count > CONTRAST * dot(sum, vec3f(1.0 / 3.0));
}

// Whether surfaces of unlike radiance meet around a pixel: by the rays of those quadrants of the
// pixels around it that touch it.
fn is_edge(pixel: vec2u, own: u32) -> bool {
    if !surfaces_meet(pixel, own) { return false; }
    return radiances_differ(pixel, own);
}

// The sum of what the four rays of a beam see, those of them that are wanted.
fn beam_sum(own: u32, first: u32, end: u32, invocation: u32) -> vec3f {
    let pixel = pixel_of(own, params.first_block, params.width);
    let point = points[own];
    let stream = camera_stream(pixel);
    var directions: array<vec3f, 4>;
    var limits = vec4f(0.0);
    for (var i = 0u; i < 4u; i++) {
        let number = (first + i) * params.samples + params.sample;
        directions[i] = camera_direction(pixel, scrambled(number, stream));
        limits[i] = select(0.0, HUGE, first + i < end);
    }
    var hits = traverse_beam(params.position, directions, limits, params.nodes, invocation);
    var sum = vec3f(0.0);
    for (var i = 0u; i < 4u; i++) {
        let number = (first + i) * params.samples + params.sample;
        let chain = specular_chain_from(
            hits[i], directions[i], limits[i], params.nodes, params.offset, number, stream, invocation,
        );
        let seen = hit_point(chain.hit, chain.direction);
        let light = light_by_code(pixel, own, nearest_around(pixel, own, point, seen))
            + seen_without_light(chain.hit, seen);
        sum += select(vec3f(0.0), light * throughput_of(chain), limits[i] > 0.0);
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
    let pixel = pixel_of(own, params.first_block, params.width);
    let is = id.x == own && pixel.x < params.width && pixel.y < params.height;
    let first = first_rays();
    let edge = is && params.rays > 0u && is_edge(pixel, own);
    let listed = list_points(edge, own, invocation);

    // The beams of all edges, one after the other: a subgroup has no idle lanes but the last.
    let beams = min((params.rays + 3u) / 4u, MOST_BEAMS);
    let all = listed.count * beams;
    let end = params.first_ray + params.rays;
    for (var start = 0u; start < all; start += 64u) {
        let beam = min(start + invocation, all - 1u);
        let ray = params.first_ray + 4u * (beam % beams);
        let last = select(0u, end, start + invocation < all);
        let sum = beam_sum(listed_points[beam / beams], ray, last, invocation);
        if start + invocation < all { beam_sums[beam] = sum; }
    }
    workgroupBarrier();

    var sum = vec3f(0.0);
    for (var beam = 0u; beam < beams; beam++) {
        if edge { sum += beam_sums[listed.rank * beams + beam]; }
    }
    // The first rays count once, whatever number of dispatches there is.
    if params.first_ray == first {
        let stored = ray_emission[own];
        sum += bitcast<vec3f>(stored.xyz);
        for (var ray = 0u; ray < first; ray++) {
            sum += light_by_code(pixel, own, code_of(stored.w, ray)) * ray_throughput(own, ray);
        }
    }
    let rays = select(first, params.edge_rays, edge);
    let hit = select(0.0, 1.0, params.first_ray == first && points[own].surface != NOTHING);
    if is { film[own] += vec4f(sum / f32(rays), hit); }
}
