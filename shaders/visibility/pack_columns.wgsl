// The bits of VPL clusters in a texture, four rows a texel.

@group(0) @binding(15) var packed_columns: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let quads = (params.rows + 3u) / 4u;
    if id.x >= quads { return; }
    let rows = min(4u * id.x + vec4u(0u, 1u, 2u, 3u), vec4u(params.rows - 1u)) + id.y * params.rows;
    let words = vec4u(bits[rows.x], bits[rows.y], bits[rows.z], bits[rows.w]);
    textureStore(packed_columns, table_place(id.y * quads + id.x), words);
}
