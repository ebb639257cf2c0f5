// Whether two points see the same surface, so that one may use the other's light.

// Least cosine between their normals; and the most that one may rise over the tangent plane of
// the other, over their distance, beyond what a smooth curve between the normals rises.
const SAME_NORMAL = 0.9;
const SAME_PLANE = 0.05;

// From their unit normals, and the way from one to the other.
fn one_surface(n: vec3f, m: vec3f, way: vec3f) -> bool {
    let cosine = dot(n, m);
    let rise = max(abs(dot(way, n)), abs(dot(way, m)));
    // The chord of an arc rises by the sine of half its angle.
    let most = SAME_PLANE + sqrt(max(0.5 - 0.5 * cosine, 0.0));
    return cosine >= SAME_NORMAL && rise * rise <= most * most * dot(way, way);
}
