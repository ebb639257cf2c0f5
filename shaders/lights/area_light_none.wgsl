// No emitting triangles.

fn sample_area_light(point: Point, at: vec2f, offset: f32) -> LightSample {
    return LightSample();
}
