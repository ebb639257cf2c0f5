// Corrects shared visibility: to some of the VPLs that a point gathers it traces a shadow ray of its own,
// and adds what that finds less what its rows of the bit matrix say. Whatever they say, the mean over
// rays is the light of VPLs that are seen from the point itself. Rays go where what a VPL would give is
// much and the point's clusters disagree about it.

// How much VPLs count of which all clusters say the same: they may all be wrong where things touch.
const AGREED = 0.2;

// Four VPLs that are drawn by their weights from all that were offered, each by itself. Chao, "A general
// purpose unequal probability sampling plan", Biometrika 1982.
struct Drawn {
    random: vec4u,
    chosen: vec4u,
    weight: vec4f,
    // Of all that were offered.
    sum: f32,
}

fn offer(drawn: Drawn, index: u32, weight: f32) -> Drawn {
    // A linear congruential generator, whose high bits are used.
    let random = drawn.random * 1664525u + 1013904223u;
    let sum = drawn.sum + weight;
    let takes = vec4f(random >> vec4u(8u)) * sum < vec4f(weight * 16777216.0);
    return Drawn(
        random,
        select(drawn.chosen, vec4u(index), takes),
        select(drawn.weight, vec4f(weight), takes),
        sum,
    );
}

// How likely a VPL is drawn that gives this unshadowed, and of which this share of the point's rows sees it.
fn weight_of_pair(light: Gathered, share: f32) -> f32 {
    let disagreement = 2.0 * sqrt(max(share * (1.0 - share), 0.0));
    return mean_and_difference(light).x * mix(AGREED, 1.0, disagreement);
}

fn share_of(rows: Rows, index: u32) -> f32 {
    return shown(vec2f(1.0), load_seen(rows, index / 32u), 1u << (index % 32u)).x;
}

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
    @builtin(subgroup_invocation_id) in_subgroup: u32,
) {
    let lane = in_subgroup & 7u;
    let at = params.first_point + min(id.x, params.points - 1u);
    let point = points[at];
    let receiver = receiver_of(point);
    let rows = row_of(at);
    let all = seen_from_everywhere(rows);
    let is_point = id.x < params.points && point.surface != NOTHING;
    let end = offset_position(point, params.offset);
    var sum = Gathered();
    for (var first = 0u; first < params.rays; first += 4u) {
        let numbers = params.first_ray + first + vec4u(0u, 1u, 2u, 3u);
        var drawn = Drawn();
        for (var i = 0u; i < 4u; i++) { drawn.random[i] = hash(numbers[i] ^ hash(at ^ params.seed)); }
        for (var word = 0u; word < params.words; word++) {
            let seen = load_seen(rows, word);
            for (var batch = 0u; batch < 32u; batch += 8u) {
                let index = 32u * word + batch;
                let vpl = vpls[32u * params.matrix_word + index + lane];
                let b = later(seen, batch);
                let facet = vec4f(vpl.normal, vpl.bound);
                let light = vec4f(vpl.intensity, vpl.mean);
                let g0 = pair(point, subgroupBroadcast(vpl.position, 0u), subgroupBroadcast(facet, 0u), subgroupBroadcast(light, 0u), all, 1u);
                drawn = offer(drawn, index + 0u, weight_of_pair(g0, shown(vec2f(1.0), b, 1u).x));
                let g1 = pair(point, subgroupBroadcast(vpl.position, 1u), subgroupBroadcast(facet, 1u), subgroupBroadcast(light, 1u), all, 1u);
                drawn = offer(drawn, index + 1u, weight_of_pair(g1, shown(vec2f(1.0), b, 2u).x));
                let g2 = pair(point, subgroupBroadcast(vpl.position, 2u), subgroupBroadcast(facet, 2u), subgroupBroadcast(light, 2u), all, 1u);
                drawn = offer(drawn, index + 2u, weight_of_pair(g2, shown(vec2f(1.0), b, 4u).x));
                let g3 = pair(point, subgroupBroadcast(vpl.position, 3u), subgroupBroadcast(facet, 3u), subgroupBroadcast(light, 3u), all, 1u);
                drawn = offer(drawn, index + 3u, weight_of_pair(g3, shown(vec2f(1.0), b, 8u).x));
                let g4 = pair(point, subgroupBroadcast(vpl.position, 4u), subgroupBroadcast(facet, 4u), subgroupBroadcast(light, 4u), all, 1u);
                drawn = offer(drawn, index + 4u, weight_of_pair(g4, shown(vec2f(1.0), b, 16u).x));
                let g5 = pair(point, subgroupBroadcast(vpl.position, 5u), subgroupBroadcast(facet, 5u), subgroupBroadcast(light, 5u), all, 1u);
                drawn = offer(drawn, index + 5u, weight_of_pair(g5, shown(vec2f(1.0), b, 32u).x));
                let g6 = pair(point, subgroupBroadcast(vpl.position, 6u), subgroupBroadcast(facet, 6u), subgroupBroadcast(light, 6u), all, 1u);
                drawn = offer(drawn, index + 6u, weight_of_pair(g6, shown(vec2f(1.0), b, 64u).x));
                let g7 = pair(point, subgroupBroadcast(vpl.position, 7u), subgroupBroadcast(facet, 7u), subgroupBroadcast(light, 7u), all, 1u);
                drawn = offer(drawn, index + 7u, weight_of_pair(g7, shown(vec2f(1.0), b, 128u).x));
            }
        }
        for (var i = 0u; i < min(4u, params.rays - first); i++) {
            let index = drawn.chosen[i];
            let weight = drawn.weight[i];
            let vpl = vpls[32u * params.matrix_word + index];
            let is = is_point && weight > 0.0;
            let origin = vpl.position + params.offset * vpl.normal;
            let limit = select(0.0, 1.0, is);
            let hit = traverse(origin, end - origin, limit, params.nodes, true, invocation);
            if is {
                let seen = select(0.0, 1.0, hit.triangle == NOTHING);
                let times = drawn.sum / weight * (seen - share_of(rows, index));
                sum += pair_of(receiver, vpl, all, 1u) * times;
            }
        }
    }
    if id.x < params.points { irradiance[at] += sum * (1.0 / f32(params.rays)); }
}
