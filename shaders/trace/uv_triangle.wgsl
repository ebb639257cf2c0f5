// Texture coordinates of a place on a triangle.

// Of the corners of all triangles.
@group(0) @binding(42) var<storage, read> uvs: array<vec2f>;

fn texture_coordinates(kind: u32, index: u32, weights: vec3f) -> vec2f {
    let at = 3u * index;
    return uvs[at] * weights.x + uvs[at + 1u] * weights.y + uvs[at + 2u] * weights.z;
}
