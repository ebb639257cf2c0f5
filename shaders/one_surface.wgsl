// Whether two points see the same surface, so that one may use the other's light.

// Least cosine between their normals, and the most that one may rise over the tangent plane of
// the other, over their distance: a flat surface, or a gentle curve.
const SAME_NORMAL = 0.97;
const SAME_PLANE = 0.05;

// From their unit normals, and the way from one to the other.
fn one_surface(n: vec3f, m: vec3f, way: vec3f) -> bool {
    let rise = max(abs(dot(way, n)), abs(dot(way, m)));
    return dot(n, m) >= SAME_NORMAL && rise * rise <= SAME_PLANE * SAME_PLANE * dot(way, way);
}
