// The triangles, where rays do not need them but what they hit does.

@group(0) @binding(2) var<storage, read> triangles: array<Triangle>;

fn load_triangle(i: u32) -> Triangle {
    return triangles[i];
}
