// Does a packet meet the boxes of a node's children? A slab test for each segment that is still open. Tighter than
// packet_shaft.wgsl; worth it where boxes are small against packets.

// Finite reciprocals of the four directions of a lane.
struct PacketBounds {
    r0: vec3f,
    r1: vec3f,
    r2: vec3f,
    r3: vec3f,
}

fn packet_bounds(low: vec3f, high: vec3f, d0: vec3f, d1: vec3f, d2: vec3f, d3: vec3f) -> PacketBounds {
    return PacketBounds(
        finite_reciprocal(d0),
        finite_reciprocal(d1),
        finite_reciprocal(d2),
        finite_reciprocal(d3),
    );
}

// Which children of a node, which these words hold, some open segment of the packet meets: a bit
// each.
fn children_met(
    s: PacketBounds,
    words: vec4u,
    origin: vec3f,
    open: vec4<bool>,
    lane: u32,
) -> u32 {
    let low0 = subgroupBroadcast(words, 0u);
    let high0 = subgroupBroadcast(words, 1u);
    let low1 = subgroupBroadcast(words, 2u);
    let high1 = subgroupBroadcast(words, 3u);
    let low2 = subgroupBroadcast(words, 4u);
    let high2 = subgroupBroadcast(words, 5u);
    let low3 = subgroupBroadcast(words, 6u);
    let high3 = subgroupBroadcast(words, 7u);
    return subgroupOr(
        select(0u, 1u, some_meet(s, low0, high0, origin, open))
        | select(0u, 2u, some_meet(s, low1, high1, origin, open))
        | select(0u, 4u, some_meet(s, low2, high2, origin, open))
        | select(0u, 8u, some_meet(s, low3, high3, origin, open))
    );
}

// Whether an open segment of the lane meets a child.
fn some_meet(s: PacketBounds, low: vec4u, high: vec4u, origin: vec3f, open: vec4<bool>) -> bool {
    let bottom = bitcast<vec3f>(low.xyz) - origin;
    let top = bitcast<vec3f>(high.xyz) - origin;
    let met = vec4<bool>(
        meets_box(s.r0, bottom, top, 1.0),
        meets_box(s.r1, bottom, top, 1.0),
        meets_box(s.r2, bottom, top, 1.0),
        meets_box(s.r3, bottom, top, 1.0),
    );
    return low.w != 0u && any(met & open);
}
