// By how much texture coordinates change along the plane of a triangle: by the change of its
// corners' weights, which are volumes over the square of the normal.

fn uv_along_triangle(shape: Triangle, way: vec3f) -> vec2f {
    let ab = shape.b - shape.a;
    let ac = shape.c - shape.a;
    let normal = cross(ab, ac);
    let scaled = normal / dot(normal, normal);
    let b = dot(cross(way, ac), scaled);
    let c = dot(cross(ab, way), scaled);
    let at = 3u * shape.index;
    return b * (uvs[at + 1u] - uvs[at]) + c * (uvs[at + 2u] - uvs[at]);
}
