// Texture coordinates of a place on a triangle or a sphere: see `on_sphere` of
// src/scene/texture/mapping.rs.

// Of the corners of all triangles.
@group(0) @binding(42) var<storage, read> uvs: array<vec2f>;

fn texture_coordinates(kind: u32, index: u32, weights: vec3f) -> vec2f {
    if (kind & SPHERE) != 0u {
        // At the poles every turn is right.
        let across = length(weights.xz);
        let turn = select(0.0, atan2(weights.x, weights.z), across > 0.0);
        return vec2f(0.5 + turn / (2.0 * PI), atan2(across, weights.y) / PI);
    }
    let at = 3u * index;
    return uvs[at] * weights.x + uvs[at + 1u] * weights.y + uvs[at + 2u] * weights.z;
}
