// The albedo of a point that a texture may vary, as `store_albedo` left it.

@group(0) @binding(44) var<storage, read_write> albedos: array<vec4f>;

// Of the point of an index.
fn albedo_of(index: u32, point: Point) -> vec3f {
    return albedos[index].rgb;
}
