// What a member with a Phong lobe gives to rows that see it, over what the brightest of all emits.

fn weights(rows: FourRows, member: u32) -> vec4f {
    let at = MEMBER_SIZE * member;
    let position = bitcast<vec4f>(textureLoad(member_table, table_place(at), 0));
    let normal = bitcast<vec4f>(textureLoad(member_table, table_place(at + 1u), 0));
    let mirrored = bitcast<vec4f>(textureLoad(member_table, table_place(at + 2u), 0));
    let specular = bitcast<vec4f>(textureLoad(member_table, table_place(at + 3u), 0));
    let all = segments(rows, position.xyz, normal.xyz);
    let cosines = -(all.ways * mirrored.xyz) * inverseSqrt(max(all.squares, vec4f(1e-37)));
    // Never 0^0.
    let powers = pow(max(cosines, vec4f(1e-20)), vec4f(mirrored.w));
    let lobe = specular.y * select(vec4f(0.0), powers, cosines > vec4f(0.0));
    // A lobe that passes a row by may meet points of its cluster.
    let there = max(lobe, vec4f(0.01));
    return position.w * min(all.geometry, vec4f(normal.w))
        + specular.x * min(all.geometry * there, vec4f(normal.w));
}
