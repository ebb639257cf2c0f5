// What tells the surfaces of pixels apart beside where they are, in 24 bits: their normals, a byte
// a coordinate.

fn surface_code(point: Point) -> u32 {
    let normal = select(point.normal, vec3f(0.0), point.surface == NOTHING);
    return pack4x8snorm(vec4f(normal, 0.0));
}

// 0 where there is none.
fn normal_of_code(code: u32) -> vec3f {
    return unpack4x8snorm(code).xyz;
}

fn of_one_lobe(a: u32, b: u32) -> bool {
    return true;
}
