// A pilot ray of each pixel, which tells the guide what is in the way. Pilot rays count for nothing
// else: samples that are drawn by what they found stay unbiased.

@group(0) @binding(4) var<storage, read> points: array<Point>;
// Of each block, eight strata of the lights an entry, two a word: how many pilot rays went to a stratum
// from the points of the block, and how many of them arrived, a byte each.
@group(0) @binding(98) var counted_pilots: texture_storage_2d<rgba32uint, write>;

// One for each stratum; in the upper half of the bits those that arrived.
var<workgroup> counts: array<atomic<u32>, MOST_STRATA>;

const ARRIVED = 0x10000u;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let index = group.x * 64u + invocation;
    let point = points[index];
    let stream = hash(hash(params.first_block * 64u + index) + params.seed);
    let u = stratified(invocation, 1.0 / 64.0, stream);
    let stratum = choose_stratum(group.x, params.strata, u.x).stratum;
    let light = sample_stratum(stratum, point, scrambled(invocation, hash(stream)), params.offset);
    let is = point.surface != NOTHING && light.faces && light.density > 0.0;
    let origin = offset_position(point, params.offset);
    let limit = select(0.0, light.limit, is);
    let hit = traverse(origin, light.toward, limit, params.nodes, true, invocation);
    let arrived = select(0u, ARRIVED, hit.triangle == NOTHING);
    if is { atomicAdd(&counts[stratum], 1u + arrived); }
    workgroupBarrier();
    let entries = (params.strata + STRATA_PER_ENTRY - 1u) / STRATA_PER_ENTRY;
    for (var entry = invocation; entry < entries; entry += 64u) {
        var words: vec4u;
        for (var i = 0u; i < 4u; i++) {
            let stratum = STRATA_PER_ENTRY * entry + 2u * i;
            words[i] = bytes_of(stratum) | (bytes_of(stratum + 1u) << 16u);
        }
        textureStore(counted_pilots, table_place(group.x * entries + entry), words);
    }
}

fn bytes_of(stratum: u32) -> u32 {
    let count = atomicLoad(&counts[stratum]);
    return (count % ARRIVED) | ((count / ARRIVED) << 8u);
}
