// From who sees which VPL cluster to who sees which VPL: a VPL has the bit of its cluster.

// Four rows a texel: word by word of 32 clusters.
@group(0) @binding(13) var column_bits: texture_2d<u32>;
// The cluster of each VPL, four a texel.
@group(0) @binding(14) var column_of: texture_2d<u32>;

// What four rows see of a cluster.
fn seen_of(column: u32, quad: u32) -> vec4u {
    let at = (column / 32u) * ((params.rows + 3u) / 4u) + quad;
    let words = textureLoad(column_bits, table_place(at), 0);
    return (words >> vec4u(column % 32u)) & vec4u(1u);
}

// An invocation has four rows.
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let row = 4u * id.x;
    if row >= params.rows { return; }
    var seen = vec4u(0u);
    for (var i = 0u; i < 8u; i++) {
        let at = 8u * (params.matrix_word + id.y) + i;
        let columns = textureLoad(column_of, table_place(at), 0);
        seen |= seen_of(columns.x, id.x) << vec4u(4u * i);
        seen |= seen_of(columns.y, id.x) << vec4u(4u * i + 1u);
        seen |= seen_of(columns.z, id.x) << vec4u(4u * i + 2u);
        seen |= seen_of(columns.w, id.x) << vec4u(4u * i + 3u);
    }
    let first = id.y * params.rows + row;
    let last = first + params.rows - row - 1u;
    // What is beyond the last row goes to it first, and is then overwritten.
    for (var i = 4u; i > 0u; i--) { bits[min(first + i - 1u, last)] = seen[i - 1u]; }
}
