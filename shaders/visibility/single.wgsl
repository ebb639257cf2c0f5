// Each shadow ray by itself: the plain twin of packet.wgsl, for adapters without
// wide subgroups.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.rows { return; }
    let point = points[params.first_point + id.x];
    let end = offset_position(point, params.offset);
    let word = params.first_word + id.y;
    var seen = 0u;
    var rays = 0u;
    let count = select(min(32u, params.vpls - 32u * word), 0u, point.surface == NOTHING);
    let stop = min(count, params.first + params.count);
    // A last round without a ray: it is not reached if the last ray's loops were left early.
    var i = params.first;
    for (; i <= stop; i++) {
        if i == stop { continue; }
        let vpl = vpls[32u * word + i];
        let between = point.position - vpl.position;
        if dot(between, point.normal) >= 0.0 || facing(between, vpl.normal) <= 0.0 { continue; }
        rays++;
        let origin = vpl.position + params.offset * vpl.normal;
        let hit = traverse(origin, end - origin, 1.0, params.nodes, true, 0u);
        if hit.triangle == NOTHING { seen |= 1u << i; }
    }
    let at = (word - params.matrix_word) * params.rows + id.x;
    bits[at] = earlier(at) | seen;
    count_rays(rays, i > stop);
}
