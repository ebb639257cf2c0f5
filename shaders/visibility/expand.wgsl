// From who sees which VPL cluster to who sees which VPL: a VPL has the bit of its cluster.

struct ExpandParams {
    rows: u32,
    matrix_word: u32,
    words: u32,
    pad: u32,
}

@group(0) @binding(0) var<storage, read> params: ExpandParams;
@group(0) @binding(6) var<storage, read_write> bits: array<u32>;
@group(0) @binding(13) var<storage, read> column_bits: array<u32>;
@group(0) @binding(14) var<storage, read> column_of: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.rows { return; }
    var seen = 0u;
    for (var i = 0u; i < 32u; i++) {
        let column = column_of[32u * (params.matrix_word + id.y) + i];
        let word = column_bits[(column / 32u) * params.rows + id.x];
        seen |= ((word >> (column % 32u)) & 1u) << i;
    }
    bits[id.y * params.rows + id.x] = seen;
}
