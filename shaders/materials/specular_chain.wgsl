// A specular chain: a ray goes on at mirrors and glass to the first surface that is neither.

struct SpecularChain {
    hit: Hit,
    // Of the last segment.
    direction: vec3f,
    // What comes back of the radiance that is seen.
    throughput: vec3f,
    // Of all segments but the last.
    length: f32,
    // Whether mirrors or glass were in the way.
    specular: bool,
    // Whether chance has chosen between reflection and refraction.
    chosen: bool,
}

// Mirrors and glass that a ray meets at most: between facing mirrors it would never end.
const MOST_SPECULAR = 32u;

// The chain of a ray whose first hit is known; with the limit 0 there is none. Point `number` of the
// sequence of `stream` chooses between reflection and refraction. All invocations of a subgroup must
// call it together.
fn specular_chain_from(
    first: Hit,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    offset: f32,
    number: u32,
    stream: u32,
    invocation: u32,
) -> SpecularChain {
    let nothing = Hit(limit, NOTHING, vec3f(0.0));
    var seen = SpecularChain(nothing, direction, vec3f(1.0), 0.0, false, false);
    var hit = first;
    var reach = limit;
    for (var i = 0u; i <= MOST_SPECULAR; i++) {
        let point = hit_point(hit, seen.direction);
        let bsdf = bsdf_of(point);
        let goes_on = reach > 0.0 && hit.triangle != NOTHING && bsdf.kind >= MIRROR;
        if reach > 0.0 { seen.hit = hit; }
        var at = vec3f(0.0);
        if goes_on {
            let u = scrambled(number, hash(stream ^ hash(i + 1u))).x;
            let sampled = sample_specular(point, bsdf, seen.direction, u);
            let back = ray_offset(point, seen.direction, offset);
            let through = ray_offset_through(point, seen.direction, offset);
            at = point.position + select(through, back, sampled.side > 0.0);
            seen.direction = sampled.direction;
            seen.throughput *= sampled.weight;
            seen.length += hit.t;
            seen.specular = true;
            seen.chosen = seen.chosen || bsdf.kind == GLASS;
            // What is met is not what is seen.
            seen.hit.triangle = NOTHING;
            if i == MOST_SPECULAR { seen.throughput = vec3f(0.0); }
        }
        reach = select(0.0, HUGE, goes_on);
        if i == MOST_SPECULAR || !some_ray(goes_on) { break; }
        hit = traverse(at, seen.direction, reach, node_count, false, invocation);
    }
    return seen;
}

fn trace_specular_chain(
    origin: vec3f,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    offset: f32,
    number: u32,
    stream: u32,
    invocation: u32,
) -> SpecularChain {
    let hit = traverse(origin, direction, limit, node_count, false, invocation);
    return specular_chain_from(
        hit, direction, limit, node_count, offset, number, stream, invocation,
    );
}

// What comes back of the radiance that is seen.
fn throughput_of(chain: SpecularChain) -> vec3f {
    return chain.throughput;
}

// The length of the way to what is seen. Flat mirrors and panes leave rays as far apart as on a
// straight way; what curves gathers or scatters them, which is left out.
fn length_of(chain: SpecularChain) -> f32 {
    return chain.length + chain.hit.t;
}

// Whether mirrors or glass were in the way.
fn is_specular(chain: SpecularChain) -> bool {
    return chain.specular;
}
