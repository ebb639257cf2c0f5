// What turns rays is mirrors.

fn turn(point: Point, finish: Finish, direction: vec3f, u: f32) -> Turned {
    return at_mirror(point, finish, direction);
}
