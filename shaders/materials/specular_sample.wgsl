// The direction in which light goes on at a mirror or glass.

struct SpecularSample {
    direction: vec3f,
    // What comes back of the radiance from there.
    weight: vec3f,
    // 1 on the side of the normal, -1 beyond.
    side: f32,
}
