// Shadow rays between rows and members that they draw, in packets. A packet is what a subgroup holds: a
// row, and members of neighbouring clusters, 4 a lane, so that eight lanes have a word. A workgroup has up
// to eight words of a row.
//
// No lane returns early: a subgroup shares its loads.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(subgroup_id) subgroup: u32,
    @builtin(subgroup_size) width: u32,
    @builtin(subgroup_invocation_id) invocation: u32,
) {
    let lane = invocation & 7u;
    // Workgroups of a row, one after the other.
    let parts = (params.words + 7u) / 8u;
    let number = workgroup.x + workgroup.y * workgroups.x;
    let row = number / parts;
    let part_word = 8u * (number % parts) + (subgroup * width + invocation) / 8u;
    let is = row < params.rows && part_word < params.words;
    let word = params.first_word + min(part_word, params.words - 1u);
    let point = points[params.first_point + min(row, params.rows - 1u)];
    let origin = offset_position(point, params.offset);

    let first = 4u * lane;
    let drawn = drawn_of(min(row, params.rows - 1u), word, lane);
    let m0 = member(drawn.x);
    let m1 = member(drawn.y);
    let m2 = member(drawn.z);
    let m3 = member(drawn.w);
    let lights = vec4u(first) + vec4u(0u, 1u, 2u, 3u);
    let asked = (lights >= vec4u(params.first)) & (lights < vec4u(params.first + params.count));
    let there = vec4<bool>(is && point.surface != NOTHING);
    let open = vec4<bool>(m0.is, m1.is, m2.is, m3.is) & asked & there;
    let d0 = m0.position + params.offset * m0.normal - origin;
    let d1 = m1.position + params.offset * m1.normal - origin;
    let d2 = m2.position + params.offset * m2.normal - origin;
    let d3 = m3.position + params.offset * m3.normal - origin;
    // Bounds of the packet's ends; a member that is not there counts as none.
    let top = vec3f(HUGE);
    let low = subgroupMin(min(
        min(select(top, d0, open.x), select(top, d1, open.y)),
        min(select(top, d2, open.z), select(top, d3, open.w)),
    ));
    let high = subgroupMax(max(
        max(select(-top, d0, open.x), select(-top, d1, open.y)),
        max(select(-top, d2, open.z), select(-top, d3, open.w)),
    ));
    let packet = unblocked(origin, low, high, d0, d1, d2, d3, open, lane);

    // The eight lanes of a word have its bits together.
    let free = vec4u(packet.open);
    var seen = (free.x | free.y << 1u | free.z << 2u | free.w << 3u) << first;
    seen |= subgroupShuffleXor(seen, 1u);
    seen |= subgroupShuffleXor(seen, 2u);
    seen |= subgroupShuffleXor(seen, 4u);
    let at = (word - params.matrix_word) * params.rows + row;
    if is && lane == 0u { bits[at] = earlier(at) | seen; }
    let opened = vec4u(open);
    let rays = subgroupAdd(opened.x + opened.y + opened.z + opened.w);
    let finished = subgroupAll(packet.finished);
    if invocation == 0u { count_rays(rays, finished); }
}
