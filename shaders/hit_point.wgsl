// Of the offset of rays from surfaces: some 8 times the rounding of a place.
const BACK = 0.25;

// What a ray has hit, on the side from which it came. Where it has hit nothing, its direction takes
// the place of a normal.
//
// The place is moved back along the surface: at a wall's foot a ray meets the wall and, by rounding
// no later, the floor behind it.
fn hit_point(hit: Hit, direction: vec3f, offset: f32) -> Point {
    if hit.triangle == NOTHING { return Point(vec3f(0.0), NOTHING, direction, 0.0); }
    let shape = load_triangle(hit.triangle);
    let normal = shape_normal(shape, hit.weights);
    let front = dot(normal, direction) < 0.0;
    let along = direction - dot(direction, normal) * normal;
    return Point(
        shape_position(shape, hit.weights) - BACK * offset * along,
        shape.material | select(0u, FRONT, front),
        select(-normal, normal, front),
        hit.t,
    );
}
