// Shadow rays in packets. A packet is what a subgroup holds: 4 neighbouring points a lane,
// all seen from one VPL.
//
// No lane returns early: a subgroup shares its loads.

@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(subgroup_invocation_id) invocation: u32,
) {
    let lane = invocation & 7u;
    let word = params.first_word + id.y;
    let first = min(4u * id.x, params.rows - 1u);
    let last = params.rows - 1u;
    let p0 = points[params.first_point + first];
    let p1 = points[params.first_point + min(first + 1u, last)];
    let p2 = points[params.first_point + min(first + 2u, last)];
    let p3 = points[params.first_point + min(first + 3u, last)];
    let e0 = offset_position(p0, params.offset);
    let e1 = offset_position(p1, params.offset);
    let e2 = offset_position(p2, params.offset);
    let e3 = offset_position(p3, params.offset);
    let is0 = 4u * id.x <= last && p0.surface != NOTHING;
    let is1 = first + 1u <= last && p1.surface != NOTHING;
    let is2 = first + 2u <= last && p2.surface != NOTHING;
    let is3 = first + 3u <= last && p3.surface != NOTHING;
    // Bounds of the packet's ends; a point that is not there counts as none.
    let top = vec3f(HUGE);
    let low = subgroupMin(min(
        min(select(top, e0, is0), select(top, e1, is1)),
        min(select(top, e2, is2), select(top, e3, is3)),
    ));
    let high = subgroupMax(max(
        max(select(-top, e0, is0), select(-top, e1, is1)),
        max(select(-top, e2, is2), select(-top, e3, is3)),
    ));

    var seen = vec4u(0u);
    var rays = 0u;
    let count = min(32u, params.vpls - 32u * word);
    let stop = min(count, params.first + params.count);
    var finished = true;
    var i = params.first;
    // A last round without rays: it is not reached if the last rays' loops were left early.
    for (; i <= stop; i++) {
        let vpl = vpls[32u * word + min(i, 31u)];
        let is = i < stop;
        let origin = vpl.position + params.offset * vpl.normal;
        let d0 = e0 - origin;
        let d1 = e1 - origin;
        let d2 = e2 - origin;
        let d3 = e3 - origin;
        // Pairs with a cosine <= 0 trace no ray.
        let b0 = p0.position - vpl.position;
        let b1 = p1.position - vpl.position;
        let b2 = p2.position - vpl.position;
        let b3 = p3.position - vpl.position;
        let open0 = is && is0 && dot(b0, p0.normal) < 0.0 && facing(b0, vpl.normal) > 0.0;
        let open1 = is && is1 && dot(b1, p1.normal) < 0.0 && facing(b1, vpl.normal) > 0.0;
        let open2 = is && is2 && dot(b2, p2.normal) < 0.0 && facing(b2, vpl.normal) > 0.0;
        let open3 = is && is3 && dot(b3, p3.normal) < 0.0 && facing(b3, vpl.normal) > 0.0;
        rays += u32(open0) + u32(open1) + u32(open2) + u32(open3);

        let packet = unblocked(
            origin, low - origin, high - origin, d0, d1, d2, d3,
            vec4<bool>(open0, open1, open2, open3), lane,
        );
        finished = finished && packet.finished;
        seen |= vec4u(packet.open) << vec4u(i & 31u);
    }

    let row = 4u * id.x;
    let at = (word - params.matrix_word) * params.rows + row;
    if row < params.rows { bits[at] = earlier(at) | seen.x; }
    if row + 1u < params.rows { bits[at + 1u] = earlier(at + 1u) | seen.y; }
    if row + 2u < params.rows { bits[at + 2u] = earlier(at + 2u) | seen.z; }
    if row + 3u < params.rows { bits[at + 3u] = earlier(at + 3u) | seen.w; }
    count_rays(rays, finished && i > stop);
}
