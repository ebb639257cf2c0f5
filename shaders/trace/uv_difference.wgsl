// By how much texture coordinates change along the plane of a triangle: by the change of its
// corners' weights, which are volumes over the square of the normal.

fn uv_along_triangle(shape: Triangle, way: vec3f) -> vec2f {
    let ab = shape.b - shape.a;
    let ac = shape.c - shape.a;
    let normal = cross(ab, ac);
    // Of a sliver it may be 0 in f32.
    let square = max(dot(normal, normal), 1e-37);
    let b = dot(cross(way, ac), normal) / square;
    let c = dot(cross(ab, way), normal) / square;
    let at = 3u * shape.index;
    return b * (uvs[at + 1u] - uvs[at]) + c * (uvs[at + 2u] - uvs[at]);
}
