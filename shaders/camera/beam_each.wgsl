// The nearest hits of the four rays of a beam, one ray after the other: the plain twin of
// beam_packet.wgsl.

// The limit 0 means no ray.
fn traverse_beam(
    origin: vec3f,
    directions: array<vec3f, 4>,
    limits: vec4f,
    node_count: u32,
    invocation: u32,
) -> array<Hit, 4> {
    var given = directions;
    var hits: array<Hit, 4>;
    for (var i = 0u; i < 4u; i++) {
        hits[i] = traverse(origin, given[i], limits[i], node_count, false, invocation);
    }
    return hits;
}
