// A constant environment: directions uniform over the sphere, by an equal-area cylinder, or by the
// cosine at the point.

const HEMISPHERE_LIGHT = 3u;

fn sample_environment_light(kind: u32, point: Point, at: vec2f, offset: f32) -> LightSample {
    let height = 1.0 - 2.0 * at.y;
    let turn = 2.0 * PI * at.x;
    let radius = sqrt(max(1.0 - height * height, 0.0));
    var direction = vec3f(radius * cos(turn), height, radius * sin(turn));
    if kind == HEMISPHERE_LIGHT { direction = cosine_hemisphere(point.normal, at); }
    let cosine = dot(direction, point.normal);
    let density = select(0.25 / PI, cosine / PI, kind == HEMISPHERE_LIGHT);
    return LightSample(direction, HUGE, cosine > 0.0, background(direction), cosine, density);
}
