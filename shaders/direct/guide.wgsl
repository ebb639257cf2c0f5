// The guide from what the pilot rays found: the probabilities of the strata of the lights in a block
// of pixels, by what they give and how much of it arrives, there and in the blocks around.

// Of the samples, how many are drawn by what would arrive if nothing were in the way, and how many go
// to all strata alike: where the pilot rays are wrong, they bound the weights of samples.
const UNSHADOWED = 0.1;
const UNIFORM = 0.01;
// Counts of pilot rays that what is known of a larger group of strata is worth.
const PRIOR = 4.0;
// Strata side by side are consecutive, four by four: so these are groups of them.
const GROUP = 4u;
const LARGE_GROUP = 16u;

var<workgroup> tries: array<atomic<u32>, MOST_STRATA>;
var<workgroup> arrivals: array<atomic<u32>, MOST_STRATA>;
// Of the strata of each invocation.
var<workgroup> sums: array<vec4f, 64>;

// Tries and arrivals of a run of strata.
fn counted(first: u32, count: u32) -> vec2f {
    var sum = vec2f(0.0);
    for (var stratum = first; stratum < min(first + count, params.strata); stratum++) {
        sum += vec2f(f32(atomicLoad(&tries[stratum])), f32(atomicLoad(&arrivals[stratum])));
    }
    return sum;
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
    for (var around = 0u; around < 25u; around++) {
        let way = vec2i(i32(around % 5u) - 2, i32(around / 5u) - 2);
        let other = i32(block) + way.y * i32(params.across) + way.x;
        let is = other >= 0 && other < i32(params.blocks)
            && column + way.x >= 0 && column + way.x < i32(params.across);
        var pilot = NO_PILOT;
        if is { pilot = pilots[u32(other) * 64u + invocation]; }
        if pilot != NO_PILOT {
            // Those nearer count more.
            let counts = 6u - u32(abs(way.x)) - u32(abs(way.y));
            atomicAdd(&tries[pilot & ~ARRIVED], counts);
            if (pilot & ARRIVED) != 0u { atomicAdd(&arrivals[pilot & ~ARRIVED], counts); }
        }
    }
    workgroupBarrier();

    // A run of consecutive strata for each invocation, whole large groups.
    let run = (params.strata + 64u * LARGE_GROUP - 1u) / (64u * LARGE_GROUP) * LARGE_GROUP;
    let first = min(invocation * run, params.strata);
    let end = min(first + run, params.strata);
    let own = counted(first, run);
    sums[invocation] = vec4f(own, 0.0, 0.0);
    workgroupBarrier();
    var all = vec2f(0.0);
    for (var i = 0u; i < 64u; i++) { all += sums[i].xy; }
    workgroupBarrier();
    let overall = (all.y + 1.0) / (all.x + 1.0);
    let row = block * params.strata;
    var given = vec2f(0.0);
    for (var large = first; large < end; large += LARGE_GROUP) {
        let of_large = arriving(counted(large, LARGE_GROUP), overall);
        for (var small = large; small < min(large + LARGE_GROUP, end); small += GROUP) {
            let of_small = arriving(counted(small, GROUP), of_large);
            for (var stratum = small; stratum < min(small + GROUP, end); stratum++) {
                // Of light that arrives with a probability, the variance is least if samples are
                // drawn by its root.
                let share = sqrt(arriving(counted(stratum, 1u), of_small));
                arriving_share[row + stratum] = share;
                given += unshadowed[row + stratum] * vec2f(1.0, share);
            }
        }
    }
    sums[invocation] = vec4f(given, 0.0, 0.0);
    workgroupBarrier();
    var before = vec2f(0.0);
    var total = vec2f(0.0);
    for (var i = 0u; i < 64u; i++) {
        let other = sums[i].xy;
        before += select(vec2f(0.0), other, i < invocation);
        total += other;
    }
    let even = 1.0 / f32(params.strata);
    for (var stratum = first; stratum < end; stratum++) {
        let light = unshadowed[row + stratum];
        before += light * vec2f(1.0, arriving_share[row + stratum]);
        let all_before = f32(stratum + 1u) * even;
        let plain = select(all_before, before.x / total.x, total.x > 0.0);
        let aimed = select(plain, before.y / total.y, total.y > 0.0);
        guide[row + stratum] = mix(mix(aimed, plain, UNSHADOWED), all_before, UNIFORM);
    }
}
