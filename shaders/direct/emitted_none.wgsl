// Rays meet nothing that samples are drawn of.

fn emitted(start: Point, met: Hit, direction: vec3f, density: f32) -> vec3f {
    return vec3f(0.0);
}
