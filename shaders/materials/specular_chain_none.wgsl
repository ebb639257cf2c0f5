// A ray ends at the first surface.

struct Sight {
    hit: Hit,
    direction: vec3f,
}

fn follow(
    origin: vec3f,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    offset: f32,
    number: u32,
    stream: u32,
    invocation: u32,
) -> Sight {
    return Sight(traverse(origin, direction, limit, node_count, false, invocation), direction);
}

// What comes back of the radiance that is seen.
fn throughput_of(sight: Sight) -> vec3f {
    return vec3f(1.0);
}

// Whether mirrors or glass have turned the ray.
fn is_turned(sight: Sight) -> bool {
    return false;
}
