// Traces the next segment of a path, through mirrors and glass.

// Scrambles what decides at mirrors and glass.
const SPECULAR_STREAM = 0x7475726eu;
// A density beside which that of shadow rays does not count.
const CERTAIN = 1e15;

// All invocations of a subgroup must call it together.
fn follow_path(
    slot: u32,
    stream: u32,
    point: Point,
    direction: vec3f,
    limit: f32,
    invocation: u32,
) -> SpecularChain {
    return trace_specular_chain(
        offset_position(point, params.offset), direction, limit, params.nodes,
        params.offset, params.first_sample + slot % params.samples,
        hash(stream ^ hash(SPECULAR_STREAM + params.bounce)), invocation,
    );
}

// The density, by solid angle, with which scattering finds what emits.
fn found_density(point: Point, scattered: BsdfSample, chain: SpecularChain) -> f32 {
    // Shadow rays do not go through mirrors or glass.
    let drawn = scattered.density * dot(point.normal, scattered.direction);
    return select(drawn, CERTAIN, is_specular(chain));
}
