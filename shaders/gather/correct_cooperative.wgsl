// Offers the VPLs of a word: eight lanes load eight of them together, one each, and broadcast them. No
// lane may be missing. The adapter may have subgroups of any width from 8.

fn offer_word(drawn: Drawn, x: Receiver, all: Seen, seen: Seen, word: u32, lane: u32) -> Drawn {
    var next = drawn;
    for (var batch = 0u; batch < 32u; batch += 8u) {
        let index = 32u * word + batch;
        let vpl = vpls[32u * params.matrix_word + index + lane];
        let position = vpl.position;
        let facet = vec4f(vpl.normal, vpl.bound);
        let light = vec4f(vpl.intensity, vpl.mean);
        let own = later(seen, batch);
        let p0 = subgroupBroadcast(position, 0u);
        let n0 = subgroupBroadcast(facet, 0u);
        let l0 = subgroupBroadcast(light, 0u);
        next = offer(next, index, pair(x, p0, n0, l0, all, 1u), share_of(own, 1u));
        let p1 = subgroupBroadcast(position, 1u);
        let n1 = subgroupBroadcast(facet, 1u);
        let l1 = subgroupBroadcast(light, 1u);
        next = offer(next, index + 1u, pair(x, p1, n1, l1, all, 1u), share_of(own, 2u));
        let p2 = subgroupBroadcast(position, 2u);
        let n2 = subgroupBroadcast(facet, 2u);
        let l2 = subgroupBroadcast(light, 2u);
        next = offer(next, index + 2u, pair(x, p2, n2, l2, all, 1u), share_of(own, 4u));
        let p3 = subgroupBroadcast(position, 3u);
        let n3 = subgroupBroadcast(facet, 3u);
        let l3 = subgroupBroadcast(light, 3u);
        next = offer(next, index + 3u, pair(x, p3, n3, l3, all, 1u), share_of(own, 8u));
        let p4 = subgroupBroadcast(position, 4u);
        let n4 = subgroupBroadcast(facet, 4u);
        let l4 = subgroupBroadcast(light, 4u);
        next = offer(next, index + 4u, pair(x, p4, n4, l4, all, 1u), share_of(own, 16u));
        let p5 = subgroupBroadcast(position, 5u);
        let n5 = subgroupBroadcast(facet, 5u);
        let l5 = subgroupBroadcast(light, 5u);
        next = offer(next, index + 5u, pair(x, p5, n5, l5, all, 1u), share_of(own, 32u));
        let p6 = subgroupBroadcast(position, 6u);
        let n6 = subgroupBroadcast(facet, 6u);
        let l6 = subgroupBroadcast(light, 6u);
        next = offer(next, index + 6u, pair(x, p6, n6, l6, all, 1u), share_of(own, 64u));
        let p7 = subgroupBroadcast(position, 7u);
        let n7 = subgroupBroadcast(facet, 7u);
        let l7 = subgroupBroadcast(light, 7u);
        next = offer(next, index + 7u, pair(x, p7, n7, l7, all, 1u), share_of(own, 128u));
    }
    return next;
}
