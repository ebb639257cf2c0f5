// What rays hit: triangles alone.

fn meet(a: vec3f, b: vec3f, c: vec3f, kind: u32, origin: vec3f, direction: vec3f) -> Meeting {
    return intersect(a - origin, b - origin, c - origin, direction);
}

// Of a place that a ray has hit.
fn shape_position(shape: Triangle, weights: vec3f) -> vec3f {
    return shape.a * weights.x + shape.b * weights.y + shape.c * weights.z;
}

fn shape_normal(shape: Triangle, weights: vec3f) -> vec3f {
    return normalize(cross(shape.b - shape.a, shape.c - shape.a));
}
