// What a ray has hit, on the side from which it came. Where it has hit nothing, its direction takes
// the place of a normal.
fn hit_point(hit: Hit, direction: vec3f) -> Point {
    if hit.triangle == NOTHING { return Point(vec3f(0.0), NOTHING, direction, 0.0); }
    let shape = load_triangle(hit.triangle);
    let normal = shape_normal(shape, hit.weights);
    let front = dot(normal, direction) < 0.0;
    return Point(
        shape_position(shape, hit.weights),
        shape.material | select(0u, FRONT, front),
        select(-normal, normal, front),
        hit.t,
    );
}
