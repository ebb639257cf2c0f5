// Lights without a surface: they face every point.

fn facing(between: vec3f, normal: vec3f) -> f32 {
    return length(between);
}
