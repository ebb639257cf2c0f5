// Specular surfaces are mirrors or glass.

fn sample_specular(point: Point, finish: Finish, direction: vec3f, u: f32) -> SpecularSample {
    if finish.kind == MIRROR { return at_mirror(point, finish, direction); }
    return at_glass(point, finish, direction, u);
}
