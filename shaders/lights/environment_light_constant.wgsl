// A constant environment: directions by the cosine.

fn sample_light(point: Point, at: vec2f, light_count: u32, offset: f32) -> LightSample {
    let direction = cosine_hemisphere(point.normal, at);
    let cosine = dot(direction, point.normal);
    return LightSample(direction, HUGE, cosine > 0.0, background(direction), cosine, cosine / PI);
}
