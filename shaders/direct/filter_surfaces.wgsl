// The surfaces that the pixels of a tile see.

// In the order of pixels: where they are, and the code of surface_plain.wgsl or surface_lobed.wgsl.
@group(0) @binding(92) var surface_table: texture_2d<u32>;

struct Surface {
    position: vec3f,
    // 0 where there is none.
    normal: vec3f,
    code: u32,
}

// That of a pixel; none beyond the tile.
fn surface_at(pixel: vec2i) -> Surface {
    let is = all(pixel >= vec2i(0)) && all(pixel < vec2i(i32(params.width), i32(params.height)));
    let at = place_of(vec2u(select(vec2i(0), pixel, is)));
    let packed = textureLoad(surface_table, table_place(at), 0);
    let normal = select(vec3f(0.0), normal_of_code(packed.w), is);
    return Surface(bitcast<vec3f>(packed.xyz), normal, packed.w);
}

fn is_like(a: Surface, b: Surface) -> bool {
    return of_one_lobe(a.code, b.code) && one_surface(a.normal, b.normal, b.position - a.position);
}
