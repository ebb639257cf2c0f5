// Does a packet meet a box? A slab test for each segment that is still open. Tighter than
// packet_shaft.wgsl; worth it where boxes are small against packets.

const HUGE = 1e30;
// 1 + 2 gamma(3): Ize, "Robust BVH Ray Traversal", JCGT 2013.
const WIDEN = 1.0000004;

// Finite reciprocals of the four directions of a lane.
struct PacketBounds {
    r0: vec3f,
    r1: vec3f,
    r2: vec3f,
    r3: vec3f,
}

fn finite_reciprocal(x: vec3f) -> vec3f {
    let huge = select(vec3f(HUGE), vec3f(-HUGE), x < vec3f(0.0));
    return select(huge, 1.0 / x, abs(x) > vec3f(1.0 / HUGE));
}

fn packet_bounds(low: vec3f, high: vec3f, d0: vec3f, d1: vec3f, d2: vec3f, d3: vec3f) -> PacketBounds {
    return PacketBounds(
        finite_reciprocal(d0),
        finite_reciprocal(d1),
        finite_reciprocal(d2),
        finite_reciprocal(d3),
    );
}

fn segment_meets(r: vec3f, low: vec3f, high: vec3f) -> bool {
    let t0 = low * r;
    let t1 = high * r;
    let first = min(t0, t1);
    let last = max(t0, t1);
    let near = max(max(first.x, first.y), max(first.z, 0.0));
    let far = min(min(last.x, last.y), min(last.z, 1.0));
    return near <= far * WIDEN;
}

// Whether some open segment of the packet meets the box, given relative to their origin.
fn may_meet(s: PacketBounds, low: vec3f, high: vec3f, open: vec4<bool>) -> bool {
    let met = (open.x && segment_meets(s.r0, low, high))
        || (open.y && segment_meets(s.r1, low, high))
        || (open.z && segment_meets(s.r2, low, high))
        || (open.w && segment_meets(s.r3, low, high));
    return subgroupAny(met);
}
