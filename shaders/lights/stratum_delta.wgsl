// Strata of lights without extent.

// A light of a stratum, each as likely as the others.
fn sample_stratum(index: u32, point: Point, u: vec2f, offset: f32) -> LightSample {
    return sample_delta_light(light_stratum(index), point, u.x, offset);
}
