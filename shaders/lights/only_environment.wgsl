// A light of one kind.

fn sample_light(point: Point, at: vec2f, offset: f32) -> LightSample {
    return sample_environment_light(0u, point, at, offset);
}
