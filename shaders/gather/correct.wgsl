// Corrects shared visibility: to some of the VPLs that a point gathers it traces a shadow ray of its own,
// and adds what that finds less what its rows of the bit matrix say. Whatever those say, the mean over
// rays is the light of the VPLs that are seen from the point itself. Rays go where what a VPL would give
// is much, and where the point's rows disagree about it.

// No invocation returns early: a subgroup shares its loads, and may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let at = params.first_point + min(id.x, params.points - 1u);
    let point = points[at];
    let receiver = receiver_of(point);
    let rows = row_of(at);
    let all = seen_from_everywhere(rows);
    let is_point = id.x < params.points && point.surface != NOTHING;
    let end = offset_position(point, params.offset);
    let stream = hash(at ^ params.seed);
    // The rays of a point are spread over the chunks of the matrix, as evenly as they may be.
    let jitter = f32(hash(stream) >> 8u) * (1.0 / 16777216.0);
    let each = f32(params.rays) / f32(params.chunks);
    let before = u32(f32(params.chunk) * each + jitter);
    let own = u32(f32(params.chunk + 1u) * each + jitter) - before;
    let most = (params.rays + params.chunks - 1u) / params.chunks;
    var sum = Gathered();
    for (var first = 0u; first < most; first += 4u) {
        var drawn = Drawn();
        let number = params.first_ray + first;
        for (var i = 0u; i < 4u; i++) { drawn.random[i] = hash(stream ^ hash(number + i) + params.chunk); }
        for (var word = 0u; word < params.words; word++) {
            drawn = offer_word(drawn, receiver, all, load_seen(rows, word), word, invocation & 7u);
        }
        for (var i = 0u; i < min(4u, most - first); i++) {
            let index = drawn.chosen[i];
            let weight = drawn.weight[i];
            let vpl = vpls[32u * params.matrix_word + index];
            let is = is_point && weight > 0.0 && first + i < own;
            let origin = vpl.position + params.offset * vpl.normal;
            let limit = select(0.0, 1.0, is);
            let hit = traverse(origin, end - origin, limit, params.nodes, true, invocation);
            if is {
                let found = select(0.0, 1.0, hit.triangle == NOTHING);
                let share = share_of(load_seen(rows, index / 32u), 1u << (index % 32u));
                let times = drawn.sum / weight * (found - share);
                sum += pair_of(receiver, vpl, all, 1u) * times;
            }
        }
    }
    if id.x < params.points { irradiance[at] += sum * (1.0 / each); }
}
