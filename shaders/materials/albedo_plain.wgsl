// The albedo of a point: that of its material.

@group(0) @binding(3) var<storage, read> materials: array<Material>;

// Of the point of an index.
fn albedo_of(index: u32, point: Point) -> vec3f {
    return materials[point.surface & ~FRONT].albedo;
}
