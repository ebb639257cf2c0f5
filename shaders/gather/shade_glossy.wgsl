// Shading of glossy scenes: a lane holds 4 points, and a subgroup goes through the VPLs that some
// of its points see, so that a VPL is loaded once for 32 pairs. No lane returns early: a subgroup
// decides together. The adapter may have subgroups of any width.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let first = params.first_point + 4u * id.x;
    let end = params.first_point + params.points;
    let i0 = min(first, end - 1u);
    let i1 = min(first + 1u, end - 1u);
    let i2 = min(first + 2u, end - 1u);
    let i3 = min(first + 3u, end - 1u);
    let x0 = receiver_of(points[i0]);
    let x1 = receiver_of(points[i1]);
    let x2 = receiver_of(points[i2]);
    let x3 = receiver_of(points[i3]);
    let r0 = row_of(i0);
    let r1 = row_of(i1);
    let r2 = row_of(i2);
    let r3 = row_of(i3);
    var total0 = Gathered();
    var total1 = Gathered();
    var total2 = Gathered();
    var total3 = Gathered();
    for (var word = 0u; word < params.words; word++) {
        let s0 = load_seen(r0, word);
        let s1 = load_seen(r1, word);
        let s2 = load_seen(r2, word);
        let s3 = load_seen(r3, word);
        // A sum a word, then the sum of those, keeps rounding small over many VPLs.
        var sum0 = Gathered();
        var sum1 = Gathered();
        var sum2 = Gathered();
        var sum3 = Gathered();
        var left = subgroupOr(seen_at_all(s0) | seen_at_all(s1) | seen_at_all(s2) | seen_at_all(s3));
        while left != 0u {
            let index = firstTrailingBit(left);
            left &= left - 1u;
            let vpl = vpls[32u * (params.matrix_word + word) + index];
            sum0 += pair_of(x0, vpl, s0, 1u << index);
            sum1 += pair_of(x1, vpl, s1, 1u << index);
            sum2 += pair_of(x2, vpl, s2, 1u << index);
            sum3 += pair_of(x3, vpl, s3, 1u << index);
        }
        total0 += sum0;
        total1 += sum1;
        total2 += sum2;
        total3 += sum3;
    }
    if first < end { irradiance[i0] += total0; }
    if first + 1u < end { irradiance[i1] += total1; }
    if first + 2u < end { irradiance[i2] += total2; }
    if first + 3u < end { irradiance[i3] += total3; }
}
