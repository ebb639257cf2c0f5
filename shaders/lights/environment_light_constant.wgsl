// A constant environment: directions uniform over the sphere, by an equal-area cylinder.

fn sample_environment_light(point: Point, at: vec2f, offset: f32) -> LightSample {
    let height = 1.0 - 2.0 * at.y;
    let turn = 2.0 * PI * at.x;
    let radius = sqrt(max(1.0 - height * height, 0.0));
    let direction = vec3f(radius * cos(turn), height, radius * sin(turn));
    let cosine = dot(direction, point.normal);
    return LightSample(direction, HUGE, cosine > 0.0, background(direction), cosine, 0.25 / PI);
}
