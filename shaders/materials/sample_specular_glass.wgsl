// Specular surfaces are glass.

fn sample_specular(point: Point, finish: Finish, direction: vec3f, u: f32) -> SpecularSample {
    return at_glass(point, finish, direction, u);
}
