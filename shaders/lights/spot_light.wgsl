// Lights without extent that shine into a cone.

struct SpotLight {
    position: vec3f,
    // The probability of all lights before this one.
    before: f32,
    intensity: vec3f,
    // The probability of this light.
    probability: f32,
    axis: vec3f,
    // Of the angle to the axis beyond which it does not shine.
    cos_outer: f32,
    // How fast the ramp rises with the cosine from there.
    slope: f32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(9) var<storage, read> lights: array<SpotLight>;

// In a unit direction. The twin of `SpotLightRecord::intensity_towards`.
fn intensity_towards(light: SpotLight, direction: vec3f) -> vec3f {
    let ramp = saturate((dot(direction, light.axis) - light.cos_outer) * light.slope);
    return light.intensity * (ramp * ramp);
}
