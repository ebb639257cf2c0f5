// Members of VPL clusters on the device, and which of them rows have drawn.

// Cluster after cluster, MEMBER_SIZE texels a member: position, weight; normal, bound.
@group(0) @binding(131) var member_table: texture_2d<u32>;
// For each quadruple of clusters and each row.
@group(0) @binding(132) var drawn_members: texture_2d<u32>;

struct Member {
    position: vec3f,
    // Whether there is one.
    is: bool,
    normal: vec3f,
}

// Which members of four clusters a row has drawn, of the quadruple `quad` of a word.
fn drawn_of(row: u32, word: u32, quad: u32) -> vec4u {
    let place = (8u * (word - params.first_word) + quad) * params.rows + row;
    return textureLoad(drawn_members, table_place(place), 0);
}

fn member(drawn: u32) -> Member {
    let is = drawn != NOTHING;
    let at = MEMBER_SIZE * select(0u, drawn, is);
    let position = textureLoad(member_table, table_place(at), 0);
    let normal = textureLoad(member_table, table_place(at + 1u), 0);
    return Member(bitcast<vec3f>(position.xyz), is, bitcast<vec3f>(normal.xyz));
}
