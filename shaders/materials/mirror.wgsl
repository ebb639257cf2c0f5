// An ideal mirror.

fn at_mirror(point: Point, finish: Finish, direction: vec3f) -> Turned {
    let cosine = -dot(direction, point.normal);
    return Turned(normalize(direction + 2.0 * cosine * point.normal), finish.specular, 1.0);
}
