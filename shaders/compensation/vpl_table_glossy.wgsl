// Virtual point lights in a table, where some surfaces are glossy.

@group(0) @binding(120) var vpl_table: texture_2d<u32>;

fn load_vpl(i: u32) -> Vpl {
    let a = bitcast<vec4f>(textureLoad(vpl_table, table_place(5u * i), 0));
    let b = bitcast<vec4f>(textureLoad(vpl_table, table_place(5u * i + 1u), 0));
    let c = bitcast<vec4f>(textureLoad(vpl_table, table_place(5u * i + 2u), 0));
    let d = bitcast<vec4f>(textureLoad(vpl_table, table_place(5u * i + 3u), 0));
    let e = bitcast<vec4f>(textureLoad(vpl_table, table_place(5u * i + 4u), 0));
    return Vpl(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.xyz, d.w, e.xyz, e.w);
}
