// Lights of one kind.

fn sample_light(kind: u32, point: Point, at: vec2f, offset: f32) -> LightSample {
    return sample_environment_light(kind, point, at, offset);
}
