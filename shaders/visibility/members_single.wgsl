// Each shadow ray between a row and a member that it draws by itself: the plain twin of
// members_packet.wgsl, for adapters without wide subgroups.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.rows { return; }
    let point = points[params.first_point + id.x];
    let end = offset_position(point, params.offset);
    let word = params.first_word + id.y;
    var seen = 0u;
    var rays = 0u;
    let count = select(32u, 0u, point.surface == NOTHING);
    let stop = min(count, params.first + params.count);
    // A last round without a ray: it is not reached if the last ray's loops were left early.
    var i = params.first;
    for (; i <= stop; i++) {
        if i == stop { continue; }
        let drawn = member(drawn_of(id.x, word, i / 4u)[i % 4u]);
        if !drawn.is { continue; }
        rays++;
        let origin = drawn.position + params.offset * drawn.normal;
        let hit = traverse(origin, end - origin, 1.0, params.nodes, true, 0u);
        if hit.triangle == NOTHING { seen |= 1u << i; }
    }
    let at = (word - params.matrix_word) * params.rows + id.x;
    bits[at] = earlier(at) | seen;
    count_rays(rays, i > stop);
}
