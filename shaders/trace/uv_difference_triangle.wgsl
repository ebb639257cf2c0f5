// By how much texture coordinates change along a triangle.

// Of the place with these weights, to one this far away in the plane.
fn uv_difference(shape: Triangle, weights: vec3f, way: vec3f) -> vec2f {
    return uv_along_triangle(shape, way);
}
