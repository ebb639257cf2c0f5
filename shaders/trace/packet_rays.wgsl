// Does a packet meet a box? A slab test for each segment that is still open. Tighter than
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

// Whether some open segment of the packet meets the box, given relative to their origin.
fn may_meet(s: PacketBounds, low: vec3f, high: vec3f, open: vec4<bool>) -> bool {
    let met = vec4<bool>(
        meets_box(s.r0, low, high, 1.0),
        meets_box(s.r1, low, high, 1.0),
        meets_box(s.r2, low, high, 1.0),
        meets_box(s.r3, low, high, 1.0),
    );
    return subgroupAny(any(met & open));
}
