// By how much texture coordinates change along a triangle or a sphere.

// From the place with these weights, in the direction and by the length of a way along the surface.
fn uv_difference(shape: Triangle, weights: vec3f, way: vec3f) -> vec2f {
    if (shape.kind & SPHERE) != 0u { return uv_along_sphere(shape.b.x, weights, way); }
    return uv_along_triangle(shape, way);
}

// The derivatives of the coordinates that `texture_coordinates` gives a sphere of this radius. At a
// pole, where u has none, it is taken a little beside it.
fn uv_along_sphere(radius: f32, normal: vec3f, way: vec3f) -> vec2f {
    let turned = way / radius;
    let across = max(length(normal.xz), 1e-3);
    let u = (normal.z * turned.x - normal.x * turned.z) / (across * across);
    let widening = dot(normal.xz, turned.xz) / across;
    return vec2f(u / (2.0 * PI), (normal.y * widening - across * turned.y) / PI);
}
