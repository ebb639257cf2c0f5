// Lights that are places on surfaces.

// How much a light faces a point: the cosine times the distance. `between` is from the light to
// the point.
fn facing(between: vec3f, normal: vec3f) -> f32 {
    return dot(between, normal);
}
