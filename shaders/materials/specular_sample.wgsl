// The way on of light at a mirror or glass.

struct Turned {
    direction: vec3f,
    // What comes back of the radiance from there.
    weight: vec3f,
    // 1 on the side of the normal, -1 beyond.
    side: f32,
}
