// What rays hit: triangles and spheres. `weights` of a sphere is its unit normal. The twin of
// src/bvh/shape.rs.

// Triangle.kind: a sphere; one that is met only where rays leave it.
const SPHERE = 0x80000000u;
const FAR = 0x40000000u;

// A ray with a sphere whose centre is given relative to its origin. Haines, Guenther and
// Akenine-Moeller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
// 2019: the discriminant from the ray's nearest point to the centre, and no difference of near
// numbers in the distance.
fn meet_sphere(center: vec3f, radius: f32, far: bool, direction: vec3f) -> Meeting {
    let square = dot(direction, direction);
    let along = dot(center, direction);
    let nearest = direction * (along / square) - center;
    let rest = radius * radius - dot(nearest, nearest);
    let outside = dot(center, center) - radius * radius;
    let root = sqrt(max(square * rest, 0.0));
    let q = along + select(root, -root, along < 0.0);
    // One distance is q / square, the other outside / q.
    let enters = outside > 0.0 && !far;
    let t = select(q / square, outside / q, enters || along < 0.0);
    let normal = nearest + direction * (select(root, -root, enters) / square);
    return Meeting(t, square > 0.0 && rest >= 0.0 && q != 0.0, normalize(normal));
}

fn meet(a: vec3f, b: vec3f, c: vec3f, kind: u32, origin: vec3f, direction: vec3f) -> Meeting {
    if (kind & SPHERE) != 0u {
        return meet_sphere(a - origin, b.x, (kind & FAR) != 0u, direction);
    }
    return intersect(a - origin, b - origin, c - origin, direction);
}

// Of a place that a ray has hit.
fn shape_position(shape: Triangle, weights: vec3f) -> vec3f {
    let flat = shape.a * weights.x + shape.b * weights.y + shape.c * weights.z;
    return select(flat, shape.a + shape.b.x * weights, (shape.kind & SPHERE) != 0u);
}

fn shape_normal(shape: Triangle, weights: vec3f) -> vec3f {
    if (shape.kind & SPHERE) != 0u { return weights; }
    return normalize(cross(shape.b - shape.a, shape.c - shape.a));
}
