// No mirrors or glass: a ray ends at the first surface.

struct SpecularChain {
    hit: Hit,
    direction: vec3f,
}

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
    return SpecularChain(first, direction);
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
    return SpecularChain(traverse(origin, direction, limit, node_count, false, invocation), direction);
}

// What comes back of the radiance that is seen.
fn throughput_of(chain: SpecularChain) -> vec3f {
    return vec3f(1.0);
}

// The length of the way to what is seen.
fn length_of(chain: SpecularChain) -> f32 {
    return chain.hit.t;
}

// Whether mirrors or glass were in the way.
fn is_specular(chain: SpecularChain) -> bool {
    return false;
}
