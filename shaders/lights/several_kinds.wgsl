// Lights of several kinds.

fn sample_light(kind: u32, point: Point, at: vec2f, offset: f32) -> LightSample {
    if kind == AREA_LIGHT { return sample_area_light(point, at, offset); }
    if kind == SPHERE_LIGHT { return sample_sphere_light(point, at, offset); }
    return sample_environment_light(kind, point, at, offset);
}
