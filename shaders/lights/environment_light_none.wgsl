// No environment.

fn sample_environment_light(kind: u32, point: Point, at: vec2f, offset: f32) -> LightSample {
    return LightSample();
}
