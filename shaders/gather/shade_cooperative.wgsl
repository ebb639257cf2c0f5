// Shading together. A lane holds 4 points. Eight lanes load eight VPLs together, one each, and
// broadcast them, so that a VPL is loaded once for 32 pairs. What none of them sees is skipped. No
// lane returns early: a subgroup shares its loads. The adapter may have subgroups of any width from
// 8.

@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(subgroup_invocation_id) invocation: u32,
) {
    let lane = invocation & 7u;
    let first = params.first_point + 4u * id.x;
    let end = params.first_point + params.points;
    let i0 = min(first, end - 1u);
    let i1 = min(first + 1u, end - 1u);
    let i2 = min(first + 2u, end - 1u);
    let i3 = min(first + 3u, end - 1u);
    let x0 = points[i0];
    let x1 = points[i1];
    let x2 = points[i2];
    let x3 = points[i3];
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
        // Batches of eight VPLs that some lane sees.
        var left = subgroupOr(seen_at_all(s0) | seen_at_all(s1) | seen_at_all(s2) | seen_at_all(s3));
        while left != 0u {
            let batch = firstTrailingBit(left) & 24u;
            left &= ~(255u << batch);
            let b0 = later(s0, batch);
            let b1 = later(s1, batch);
            let b2 = later(s2, batch);
            let b3 = later(s3, batch);
            let vpl = vpls[32u * (params.matrix_word + word) + batch + lane];
            let light = vec4f(vpl.intensity, vpl.mean);
            let facet = vec4f(vpl.normal, vpl.bound);
            let p0 = subgroupBroadcast(vpl.position, 0u);
            let n0 = subgroupBroadcast(facet, 0u);
            let l0 = subgroupBroadcast(light, 0u);
            sum0 += pair(x0, p0, n0, l0, b0, 1u);
            sum1 += pair(x1, p0, n0, l0, b1, 1u);
            sum2 += pair(x2, p0, n0, l0, b2, 1u);
            sum3 += pair(x3, p0, n0, l0, b3, 1u);
            let p1 = subgroupBroadcast(vpl.position, 1u);
            let n1 = subgroupBroadcast(facet, 1u);
            let l1 = subgroupBroadcast(light, 1u);
            sum0 += pair(x0, p1, n1, l1, b0, 2u);
            sum1 += pair(x1, p1, n1, l1, b1, 2u);
            sum2 += pair(x2, p1, n1, l1, b2, 2u);
            sum3 += pair(x3, p1, n1, l1, b3, 2u);
            let p2 = subgroupBroadcast(vpl.position, 2u);
            let n2 = subgroupBroadcast(facet, 2u);
            let l2 = subgroupBroadcast(light, 2u);
            sum0 += pair(x0, p2, n2, l2, b0, 4u);
            sum1 += pair(x1, p2, n2, l2, b1, 4u);
            sum2 += pair(x2, p2, n2, l2, b2, 4u);
            sum3 += pair(x3, p2, n2, l2, b3, 4u);
            let p3 = subgroupBroadcast(vpl.position, 3u);
            let n3 = subgroupBroadcast(facet, 3u);
            let l3 = subgroupBroadcast(light, 3u);
            sum0 += pair(x0, p3, n3, l3, b0, 8u);
            sum1 += pair(x1, p3, n3, l3, b1, 8u);
            sum2 += pair(x2, p3, n3, l3, b2, 8u);
            sum3 += pair(x3, p3, n3, l3, b3, 8u);
            let p4 = subgroupBroadcast(vpl.position, 4u);
            let n4 = subgroupBroadcast(facet, 4u);
            let l4 = subgroupBroadcast(light, 4u);
            sum0 += pair(x0, p4, n4, l4, b0, 16u);
            sum1 += pair(x1, p4, n4, l4, b1, 16u);
            sum2 += pair(x2, p4, n4, l4, b2, 16u);
            sum3 += pair(x3, p4, n4, l4, b3, 16u);
            let p5 = subgroupBroadcast(vpl.position, 5u);
            let n5 = subgroupBroadcast(facet, 5u);
            let l5 = subgroupBroadcast(light, 5u);
            sum0 += pair(x0, p5, n5, l5, b0, 32u);
            sum1 += pair(x1, p5, n5, l5, b1, 32u);
            sum2 += pair(x2, p5, n5, l5, b2, 32u);
            sum3 += pair(x3, p5, n5, l5, b3, 32u);
            let p6 = subgroupBroadcast(vpl.position, 6u);
            let n6 = subgroupBroadcast(facet, 6u);
            let l6 = subgroupBroadcast(light, 6u);
            sum0 += pair(x0, p6, n6, l6, b0, 64u);
            sum1 += pair(x1, p6, n6, l6, b1, 64u);
            sum2 += pair(x2, p6, n6, l6, b2, 64u);
            sum3 += pair(x3, p6, n6, l6, b3, 64u);
            let p7 = subgroupBroadcast(vpl.position, 7u);
            let n7 = subgroupBroadcast(facet, 7u);
            let l7 = subgroupBroadcast(light, 7u);
            sum0 += pair(x0, p7, n7, l7, b0, 128u);
            sum1 += pair(x1, p7, n7, l7, b1, 128u);
            sum2 += pair(x2, p7, n7, l7, b2, 128u);
            sum3 += pair(x3, p7, n7, l7, b3, 128u);
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
