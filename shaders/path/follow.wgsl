// What a path sees in the direction in which it goes on.

// Scrambles what decides at mirrors and glass.
const TURN_STREAM = 0x7475726eu;
// So dense is no other way to the same place.
const CERTAIN = 1e15;

// All invocations of a subgroup must call it together.
fn follow_path(
    slot: u32,
    stream: u32,
    point: Point,
    direction: vec3f,
    limit: f32,
    invocation: u32,
) -> Sight {
    return follow(
        ray_end(point, params.offset), direction, limit, params.nodes,
        params.offset, params.first_sample + slot % params.samples,
        hash(stream ^ hash(TURN_STREAM + params.bounce)), invocation,
    );
}

// The density, by solid angle, with which scattering finds what emits.
fn found_density(point: Point, scattered: Scattered, sight: Sight) -> f32 {
    // No shadow ray would have gone this way if it was turned.
    let drawn = scattered.density * dot(point.normal, scattered.direction);
    return select(drawn, CERTAIN, is_turned(sight));
}
