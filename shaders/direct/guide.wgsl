// The guide from what the pilot rays found: the probabilities of the strata of the lights in a block
// of pixels, by what they give and how much of it arrives, there and in the blocks around.

// Of each block and stratum of the lights, what it gives unshadowed.
@group(0) @binding(86) var<storage, read_write> unshadowed: array<f32>;
// Of each block, eight strata an entry, two a word: how many pilot rays went to a stratum from the points
// of the block, and how many of them arrived, a byte each.
@group(0) @binding(99) var pilots: texture_2d<u32>;
// Its probability and all before it, and the share of its light that is thought to arrive, or what
// samples are drawn by for it.
@group(0) @binding(100) var made_guide: texture_storage_2d<rg32uint, write>;

// Of the samples, how many are drawn by what would arrive if nothing were in the way, and how many go
// to all strata alike: where the pilot rays are wrong, they bound the weights of samples.
const UNSHADOWED = 0.1;
const UNIFORM = 0.03;
// Counts of pilot rays that what is known of a larger group of strata is worth.
const PRIOR = 4.0;
// Strata side by side are consecutive, four by four: so these are groups of them.
const GROUP = 4u;
const LARGE_GROUP = 16u;

// An even sky is open where this share of the pilot rays to it arrives.
const OPEN = 0.9;

// Pilot rays, and those of them that arrived.
var<workgroup> tried: array<vec2f, MOST_STRATA>;
// Of each stratum, the unshadowed light that is drawn from, and the share that is thought to arrive.
var<workgroup> drawn: array<vec2f, MOST_STRATA>;
// Of the strata of each invocation, and of all.
var<workgroup> sums: array<vec4f, 64>;
var<workgroup> whole: vec4f;

// Tries and arrivals of a run of strata.
fn counted(first: u32, count: u32) -> vec2f {
    var sum = vec2f(0.0);
    for (var stratum = first; stratum < min(first + count, params.strata); stratum++) {
        sum += tried[stratum];
    }
    return sum;
}

// Whether a stratum is drawn from.
fn is_drawn(stratum: u32, is_open: bool) -> bool {
    let of_sky = stratum < params.even_sky;
    let hemisphere = params.even_sky > 0u && stratum == params.strata - 1u;
    return select(!hemisphere, !of_sky, is_open);
}

// The share that arrives, where a share is thought to beforehand.
fn arriving(counts: vec2f, before: f32) -> f32 {
    return (counts.y + PRIOR * before) / (counts.x + PRIOR);
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let block = group.x;
    let column = i32((params.first_block + block) % params.across);
    let entries = (params.strata + STRATA_PER_ENTRY - 1u) / STRATA_PER_ENTRY;
    for (var entry = invocation; entry < entries; entry += 64u) {
        // Two sums a word: no weighted sum of 25 bytes overflows.
        var tries = vec4u(0u);
        var arrivals = vec4u(0u);
        let blocks_around = select(0u, 25u, params.is_piloted != 0u);
        for (var around = 0u; around < blocks_around; around++) {
            let way = vec2i(i32(around % 5u) - 2, i32(around / 5u) - 2);
            let other = i32(block) + way.y * i32(params.across) + way.x;
            let is = other >= 0 && other < i32(params.blocks)
                && column + way.x >= 0 && column + way.x < i32(params.across);
            let at = u32(select(i32(block), other, is)) * entries + entry;
            let words = textureLoad(pilots, table_place(at), 0);
            // Those nearer count more.
            let weight = vec4u(select(0u, u32(6 - abs(way.x) - abs(way.y)), is));
            tries += weight * (words & vec4u(0xff00ffu));
            arrivals += weight * ((words >> vec4u(8u)) & vec4u(0xff00ffu));
        }
        for (var i = 0u; i < STRATA_PER_ENTRY; i++) {
            let shift = 16u * (i % 2u);
            let counts = vec2u(tries[i / 2u] >> shift, arrivals[i / 2u] >> shift);
            tried[STRATA_PER_ENTRY * entry + i] = vec2f(counts & vec2u(0xffffu));
        }
    }
    workgroupBarrier();

    // A large group of strata for each invocation that has one.
    let runs = (params.strata + LARGE_GROUP - 1u) / LARGE_GROUP;
    let first = min(invocation * LARGE_GROUP, params.strata);
    let end = min(first + LARGE_GROUP, params.strata);
    if invocation < runs {
        let of_sky = counted(first, select(0u, LARGE_GROUP, first < params.even_sky));
        let of_hemisphere = select(0u, 1u, params.even_sky > 0u && end == params.strata);
        sums[invocation] =
            vec4f(counted(first, LARGE_GROUP), of_sky + counted(params.strata - 1u, of_hemisphere));
    }
    workgroupBarrier();
    if invocation == 0u {
        var sum = vec4f(0.0);
        for (var i = 0u; i < runs; i++) { sum += sums[i]; }
        whole = sum;
    }
    workgroupBarrier();
    let counts = whole;
    let all = counts.xy;
    let is_open = counts.z > 0.0 && counts.w >= OPEN * counts.z;
    let overall = (all.y + 1.0) / (all.x + 1.0);
    let row = block * params.strata;
    var given = vec3f(0.0);
    let of_large = arriving(counted(first, LARGE_GROUP), overall);
    for (var small = first; small < end; small += GROUP) {
        let of_small = arriving(counted(small, GROUP), of_large);
        for (var stratum = small; stratum < min(small + GROUP, end); stratum++) {
            // Of light that arrives with a probability, the variance is least if samples are drawn
            // by its root. What is not drawn from gives nothing: should the rounding of sums leave it
            // some probability, what is drawn counts for nothing.
            let is = is_drawn(stratum, is_open);
            let share = select(0.0, sqrt(arriving(counted(stratum, 1u), of_small)), is);
            let light = select(0.0, unshadowed[row + stratum], is);
            drawn[stratum] = vec2f(light, share);
            given += vec3f(light * vec2f(1.0, share), f32(is));
        }
    }
    // In place of the sums, what is before each.
    sums[invocation] = vec4f(given, 0.0);
    workgroupBarrier();
    if invocation == 0u {
        var sum = vec4f(0.0);
        for (var i = 0u; i < runs; i++) {
            let own = sums[i];
            sums[i] = sum;
            sum += own;
        }
        whole = sum;
    }
    workgroupBarrier();
    // Light, light that arrives, and strata.
    var before = sums[invocation].xyz;
    let total = whole.xyz;
    for (var stratum = first; stratum < end; stratum++) {
        let light = drawn[stratum].x;
        let share = drawn[stratum].y;
        before += vec3f(light * vec2f(1.0, share), f32(is_drawn(stratum, is_open)));
        let even = before.z / total.z;
        let plain = select(even, before.x / total.x, total.x > 0.0);
        let aimed = select(plain, before.y / total.y, total.y > 0.0);
        let probability = mix(mix(aimed, plain, UNSHADOWED), even, UNIFORM);
        let pair = bitcast<vec2u>(vec2f(probability, share));
        textureStore(made_guide, table_place(row + stratum), vec4u(pair, 0u, 0u));
    }
}
