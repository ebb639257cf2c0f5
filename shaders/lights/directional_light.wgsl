// Lights infinitely far away.

struct DirectionalLight {
    // Unit vector to where the light comes from.
    toward: vec3f,
    // The probability of all lights before this one.
    before: f32,
    // Of a surface across it.
    irradiance: vec3f,
    // The probability of this light.
    probability: f32,
}

@group(0) @binding(9) var<storage, read> lights: array<DirectionalLight>;

fn light_of(index: u32, point: Point, offset: f32) -> LightSample {
    let light = lights[index];
    let cosine = dot(light.toward, point.normal);
    return LightSample(
        light.toward,
        HUGE,
        cosine > 0.0,
        light.irradiance,
        cosine,
        light.probability,
    );
}
