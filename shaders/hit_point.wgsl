// What a ray has hit, on the side from which it came. Where it has hit nothing, its direction takes
// the place of a normal.
fn hit_point(hit: Hit, direction: vec3f) -> Point {
    if hit.triangle == NOTHING { return Point(vec3f(0.0), NOTHING, direction, 0.0); }
    let corners = load_triangle(hit.triangle);
    let normal = normalize(cross(corners.b - corners.a, corners.c - corners.a));
    let front = dot(normal, direction) < 0.0;
    return Point(
        corners.a * hit.weights.x + corners.b * hit.weights.y + corners.c * hit.weights.z,
        corners.material | select(0u, FRONT, front),
        select(-normal, normal, front),
        hit.t,
    );
}
