// What a diffuse member gives to rows that see it, over what the brightest of all emits.

fn weights(rows: FourRows, member: u32) -> vec4f {
    let at = MEMBER_SIZE * member;
    let position = bitcast<vec4f>(textureLoad(member_table, table_place(at), 0));
    let normal = bitcast<vec4f>(textureLoad(member_table, table_place(at + 1u), 0));
    return position.w * min(segments(rows, position.xyz, normal.xyz).geometry, vec4f(normal.w));
}
