// What turns rays is glass.

fn turn(point: Point, finish: Finish, direction: vec3f, u: f32) -> Turned {
    return at_glass(point, finish, direction, u);
}
