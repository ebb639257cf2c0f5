// The first rays of a pixel, and what is known of them. There are four over all its samples, or the
// samples themselves: few enough to be traced everywhere, and as a beam. What they meet becomes the
// pixel's visible point, once; to the others a visible point around gives its light.

const MOST_FIRST = 4u;

// First rays of a sample.
fn first_rays() -> u32 {
    let most = min((MOST_FIRST + params.samples - 1u) / params.samples, params.edge_rays);
    return 1u << firstLeadingBit(most);
}

// Where in the pixel they go. Four of them are one in each quadrant, and come in their order.
fn first_places(stream: u32) -> array<vec2f, 4> {
    var places = array<vec2f, 4>(vec2f(0.5), vec2f(0.5), vec2f(0.5), vec2f(0.5));
    let rays = first_rays();
    for (var i = 0u; i < rays; i++) {
        let place = scrambled(i * params.samples + params.sample, stream);
        let quadrant = u32(place.x >= 0.5) + 2u * u32(place.y >= 0.5);
        places[select(i, quadrant, rays == MOST_FIRST)] = place;
    }
    return places;
}

// Light that a ray sees beside what surfaces reflect is summed over a pixel's first rays. In w, for
// each of them, a byte: which of the 3 x 3 pixels around has the visible point whose light it takes.
const NO_LIGHT = 15u;
// The point is on another surface, as no point around is on the one that the ray meets.
const UNLIKE = 16u;

fn code_of(codes: u32, ray: u32) -> u32 {
    return (codes >> (8u * ray)) & 255u;
}

// Throughput of a specular chain: 9 bits a channel under an exponent of 5.
fn pack_throughput(throughput: vec3f) -> u32 {
    let most = max(max(throughput.x, throughput.y), max(throughput.z, 1e-4));
    let exponent = clamp(i32(floor(log2(most))) + 1, -15, 16);
    let steps = min(vec3u(round(throughput * exp2(f32(9 - exponent)))), vec3u(511u));
    return steps.x | (steps.y << 9u) | (steps.z << 18u) | (u32(exponent + 15) << 27u);
}

fn unpack_throughput(packed: u32) -> vec3f {
    let steps = vec3u(packed, packed >> 9u, packed >> 18u) & vec3u(511u);
    return vec3f(steps) * exp2(f32(i32(packed >> 27u) - 24));
}
