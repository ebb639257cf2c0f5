// No emitting spheres.

fn sample_sphere_light(point: Point, at: vec2f, offset: f32) -> LightSample {
    return LightSample();
}
