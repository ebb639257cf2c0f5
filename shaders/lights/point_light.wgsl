// Lights without extent that shine alike in all directions.

struct PointLight {
    position: vec3f,
    // The probability of all lights before this one.
    before: f32,
    intensity: vec3f,
    // The probability of this light.
    probability: f32,
}

@group(0) @binding(9) var<storage, read> lights: array<PointLight>;

fn intensity_towards(light: PointLight, direction: vec3f) -> vec3f {
    return light.intensity;
}
