// What turns rays is mirrors or glass.

fn turn(point: Point, finish: Finish, direction: vec3f, u: f32) -> Turned {
    if finish.kind == MIRROR { return at_mirror(point, finish, direction); }
    return at_glass(point, finish, direction, u);
}
