// Rays that escape find nothing, or nothing that samples are drawn of.

fn escaping(direction: vec3f, density: f32) -> vec3f {
    return vec3f(0.0);
}
