// Specular surfaces are mirrors.

fn sample_specular(point: Point, finish: Finish, direction: vec3f, u: f32) -> SpecularSample {
    return at_mirror(point, finish, direction);
}
