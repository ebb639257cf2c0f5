// Tables in textures: where a texel is. TABLE_WIDTH of src/gpu/texture.rs is in it.

fn table_place(i: u32) -> vec2u {
    return vec2u(i & 8191u, i >> 13u);
}
