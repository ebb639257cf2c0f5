// Does a packet meet the boxes of a node's children? One test for all its segments: interval arithmetic over the
// bounds of their ends, as in Wald et al., "Ray Tracing Deformable Scenes using Dynamic
// Bounding Volume Hierarchies", 2007. Cheapest where boxes are large against packets.

// The slabs' distances and the bounds of the ends are rounded.
const WIDEN_SHAFT = 1.000001;

// Of segments from the origin to a box of ends: reciprocals of the box's sides.
struct PacketBounds {
    // 1 / high where high > 0, 1 / low where low < 0; elsewhere beyond reach.
    enter_up: vec3f,
    enter_down: vec3f,
    // 1 / low where low > 0, 1 / high where high < 0; elsewhere 0, with `never` set.
    leave_up: vec3f,
    leave_down: vec3f,
    never_up: vec3f,
    never_down: vec3f,
}

fn packet_bounds(low: vec3f, high: vec3f, d0: vec3f, d1: vec3f, d2: vec3f, d3: vec3f) -> PacketBounds {
    let up = high > vec3f(1.0 / HUGE);
    let down = low < vec3f(-1.0 / HUGE);
    let all_up = low > vec3f(1.0 / HUGE);
    let all_down = high < vec3f(-1.0 / HUGE);
    return PacketBounds(
        select(vec3f(HUGE), 1.0 / high, up),
        select(vec3f(-HUGE), 1.0 / low, down),
        select(vec3f(0.0), 1.0 / low, all_up),
        select(vec3f(0.0), 1.0 / high, all_down),
        select(vec3f(HUGE), vec3f(0.0), all_up),
        select(vec3f(HUGE), vec3f(0.0), all_down),
    );
}

// Which children of a node, which these words hold, some segment of the packet may meet: a bit each.
// Two lanes test a child.
fn children_met(
    s: PacketBounds,
    words: vec4u,
    origin: vec3f,
    open: vec4<bool>,
    lane: u32,
) -> u32 {
    let own = bitcast<vec3f>(words.xyz) - origin;
    let other = subgroupShuffle(own, lane ^ 1u);
    let low = select(own, other, (lane & 1u) != 0u);
    let high = select(other, own, (lane & 1u) != 0u);
    let is = subgroupShuffle(words.w, lane & 6u) != 0u;
    let enter = max(low * s.enter_up, high * s.enter_down);
    let leave = min(high * s.leave_up + s.never_up, low * s.leave_down + s.never_down);
    let near = max(max(enter.x, enter.y), max(enter.z, 0.0));
    let far = min(min(leave.x, leave.y), min(leave.z, 1.0));
    return subgroupOr(select(0u, 1u << (lane >> 1u), is && near <= far * WIDEN_SHAFT));
}
