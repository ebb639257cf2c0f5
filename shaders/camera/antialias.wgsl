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
@group(0) @binding(90) var<storage, read> ray_emission: array<vec4u>;
@group(0) @binding(91) var<storage, read> ray_highlights: array<vec4f>;

// Most rays of a pixel in one dispatch, a beam of four each.
const MOST_BEAMS = 8u;
// How far the radiances of an edge are apart, over their mean, to be worth more rays.
const CONTRAST = 0.25;

var<workgroup> edge_bits: array<atomic<u32>, 2>;
var<workgroup> edge_points: array<u32, 64>;
var<workgroup> beam_sums: array<vec3f, 512>;

// The light that a visible point reflects into a ray.
fn light_by_code(pixel: vec2u, own: u32, code: u32) -> vec3f {
    let light = radiance[around(pixel, own, min(code & 15u, 8u))].rgb;
    return select(light, vec3f(0.0), code == NO_LIGHT);
}

// Whether surfaces of unlike radiance meet around a pixel: by the rays of those quadrants of the
// pixels around it that touch it.
fn is_edge(pixel: vec2u, own: u32) -> bool {
    let rays = first_rays();
    var reference: Point;
    var count = 0.0;
    var differ = false;
    var low = vec3f(HUGE);
    var high = vec3f(0.0);
    var sum = vec3f(0.0);
    // The quadrants of 2 x 2 pixels in their rows, those in the middle being the pixel itself.
    for (var i = 0u; i < 16u; i++) {
        let cell = vec2u(i % 4u, i / 4u) + 1u;
        let way = vec2i(cell / 2u) - 1;
        let other = vec2i(pixel) + way;
        if all(way == vec2i(0)) || !in_tile(other) { continue; }
        let index = point_at(other);
        let ray = ((cell.x & 1u) + 2u * (cell.y & 1u)) % rays;
        let code = code_of(ray_emission[index].w, ray);
        var seen = points[around(vec2u(other), index, min(code & 15u, 8u))];
        if code == NO_LIGHT { seen.surface = NOTHING; }
        let light = light_by_code(vec2u(other), index, code) * ray_throughput(index, ray)
            + ray_highlights[index][ray];
        if count == 0.0 { reference = seen; }
        differ = differ || (code & UNLIKE) != 0u || !alike(reference, seen)
            || stored_throughput(index).w > 0.0;
        low = min(low, light);
        high = max(high, light);
        sum += light;
        count += 1.0;
    }
    let apart = max(high.x - low.x, max(high.y - low.y, high.z - low.z));
    return differ && apart * count > CONTRAST * dot(sum, vec3f(1.0 / 3.0));
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
    if edge { atomicOr(&edge_bits[invocation / 32u], 1u << (invocation % 32u)); }
    workgroupBarrier();
    let bits = vec2u(atomicLoad(&edge_bits[0]), atomicLoad(&edge_bits[1]));
    // How many edges come before, and all of them.
    let before = countOneBits(bits.x & ((1u << min(invocation, 31u)) - 1u));
    let later = countOneBits(bits.x) + countOneBits(bits.y & ((1u << (invocation % 32u)) - 1u));
    let rank = select(before, later, invocation >= 32u);
    if edge { edge_points[rank] = own; }
    workgroupBarrier();

    // The beams of all edges, one after the other: a subgroup has no idle lanes but the last.
    let beams = min((params.rays + 3u) / 4u, MOST_BEAMS);
    let all = (countOneBits(bits.x) + countOneBits(bits.y)) * beams;
    let end = params.first_ray + params.rays;
    for (var start = 0u; start < all; start += 64u) {
        let beam = min(start + invocation, all - 1u);
        let ray = params.first_ray + 4u * (beam % beams);
        let last = select(0u, end, start + invocation < all);
        let sum = beam_sum(edge_points[beam / beams], ray, last, invocation);
        if start + invocation < all { beam_sums[beam] = sum; }
    }
    workgroupBarrier();

    var sum = vec3f(0.0);
    for (var beam = 0u; beam < beams; beam++) {
        if edge { sum += beam_sums[rank * beams + beam]; }
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
