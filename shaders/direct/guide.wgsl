// The guide from what the pilot rays found: the probabilities of the strata of the lights in a block
// of pixels, by what they give and how much of it arrives, there and in the blocks around.

// Of the samples, how many are drawn by what would arrive if nothing were in the way, and how many go
// to all strata alike: where the pilot rays are wrong, they bound the weights of samples.
const UNSHADOWED = 0.05;
const UNIFORM = 0.01;
// How many pilot rays the mean of all strata counts like, for each.
const PRIOR = 3.0;

var<workgroup> tries: array<atomic<u32>, MOST_STRATA>;
var<workgroup> arrivals: array<atomic<u32>, MOST_STRATA>;

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
    if invocation == 0u {
        let first = block * params.strata;
        var all = 1.0;
        var arrived = 1.0;
        for (var stratum = 0u; stratum < params.strata; stratum++) {
            all += f32(atomicLoad(&tries[stratum]));
            arrived += f32(atomicLoad(&arrivals[stratum]));
        }
        var sums = vec2f(0.0);
        for (var stratum = 0u; stratum < params.strata; stratum++) {
            let seen = (f32(atomicLoad(&arrivals[stratum])) + PRIOR * arrived / all)
                / (f32(atomicLoad(&tries[stratum])) + PRIOR);
            // Of light that arrives with a probability, the variance is least if samples are drawn by
            // its root.
            let share = sqrt(seen);
            arriving_share[first + stratum] = share;
            sums += unshadowed[first + stratum] * vec2f(1.0, share);
        }
        let even = 1.0 / f32(params.strata);
        var before = 0.0;
        for (var stratum = 0u; stratum < params.strata; stratum++) {
            let given = unshadowed[first + stratum];
            let plain = select(even, given / sums.x, sums.x > 0.0);
            let seen = given * arriving_share[first + stratum];
            let aimed = select(plain, seen / sums.y, sums.y > 0.0);
            before += mix(mix(aimed, plain, UNSHADOWED), even, UNIFORM);
            guide[first + stratum] = before;
        }
    }
}
