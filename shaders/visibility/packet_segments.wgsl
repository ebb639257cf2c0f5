// The segments of a packet that nothing blocks: 4 a lane, all from one origin. The packet goes through
// the hierarchy as one: a node's children are tested by `children_met` of the packet_*.wgsl that is
// linked, a leaf's shapes against each segment by `blocks` of the blocker_*.wgsl.
//
// No lane may be missing: a subgroup shares its loads.

struct Unblocked {
    // Those of the lane's that nothing blocks.
    open: vec4<bool>,
    // Whether the loops came to their end, which some drivers bound.
    finished: bool,
}

// Of the segments `d` from the origin that are open. Seen from there, all ends of the packet are
// within `low` and `high`.
fn unblocked(
    origin: vec3f,
    low: vec3f,
    high: vec3f,
    d0: vec3f,
    d1: vec3f,
    d2: vec3f,
    d3: vec3f,
    open: vec4<bool>,
    lane: u32,
) -> Unblocked {
    var open0 = open.x;
    var open1 = open.y;
    var open2 = open.z;
    var open3 = open.w;
    let bounds = packet_bounds(low, high, d0, d1, d2, d3);
    let none = !subgroupAny(open0 || open1 || open2 || open3);
    // The way to the middle of the packet's ends.
    let ahead = low + high;
    var stack = Stack();
    var link = select(ROOT, 0u, none);
    while link != 0u {
        // Down to the next leaf that the packet may meet.
        while link != 0u && (link & 7u) == 0u {
            let words = textureLoad(node_table, table_place(link + lane), 0);
            let still = vec4<bool>(open0, open1, open2, open3);
            let met = children_met(bounds, words, origin, still, lane);
            link = next_child(&stack, words, met, ahead, lane);
        }
        let end = link / 8u + link % 8u;
        for (var j = link / 8u; j < end; j++) {
            let loaded = textureLoad(triangle_table, table_place(3u * j + min(lane, 2u)), 0);
            let one = subgroupBroadcast(loaded, 0u);
            let two = subgroupBroadcast(loaded, 1u);
            let three = subgroupBroadcast(loaded, 2u);
            let k = blocker(
                bitcast<vec3f>(one.xyz), bitcast<vec3f>(two.xyz), bitcast<vec3f>(three.xyz),
                three.w, two.w, origin,
            );
            open0 = open0 && !blocks(k, d0);
            open1 = open1 && !blocks(k, d1);
            open2 = open2 && !blocks(k, d2);
            open3 = open3 && !blocks(k, d3);
        }
        if !subgroupAny(open0 || open1 || open2 || open3) { break; }
        link = next_link(&stack, 0u, 0u, lane);
    }
    let left = vec4<bool>(open0, open1, open2, open3);
    return Unblocked(left, link == 0u || !any(left));
}
