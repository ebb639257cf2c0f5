// What a path of bias compensation is thought to see of a virtual point light: what the cluster of
// its visible point sees of the light's cluster.

// Of each visible point.
@group(0) @binding(12) var<storage, read> cluster_of: array<u32>;
// As for shading: see visibility/expand.wgsl.
@group(0) @binding(13) var column_bits: texture_2d<u32>;
@group(0) @binding(14) var column_of: texture_2d<u32>;

// A path is not where its visible point is, and every light has to have its chance.
const UNSEEN = 0.1;

struct Sight {
    quad: u32,
    row: u32,
}

fn sight_of(slot: u32) -> Sight {
    let row = cluster_of[slot / params.samples];
    return Sight(row / 4u, row % 4u);
}

fn thought_seen(sight: Sight, light: u32) -> f32 {
    let column = textureLoad(column_of, table_place(light / 4u), 0)[light % 4u];
    let words = textureLoad(column_bits, table_place(column / 32u * params.quads + sight.quad), 0);
    return select(UNSEEN, 1.0, ((words[sight.row] >> (column % 32u)) & 1u) != 0u);
}
