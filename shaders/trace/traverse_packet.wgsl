// Closest and any hit for a subgroup that goes through the hierarchy as one: as
// traverse.wgsl, for rays that are near each other. All lanes must call it together.

fn load_triangle(i: u32) -> Triangle {
    let one = textureLoad(triangle_table, table_place(3u * i), 0);
    let two = textureLoad(triangle_table, table_place(3u * i + 1u), 0);
    let three = textureLoad(triangle_table, table_place(3u * i + 2u), 0);
    return Triangle(
        bitcast<vec3f>(one.xyz),
        one.w,
        bitcast<vec3f>(two.xyz),
        two.w,
        bitcast<vec3f>(three.xyz),
        three.w,
    );
}

// Whether some ray that is traced together with this one wants it.
fn some_ray(is: bool) -> bool {
    return subgroupAny(is);
}

// Whether the ray meets a child, which these words hold, at 0 <= t <= reach.
fn meets_child(low: vec4u, high: vec4u, reciprocal: vec3f, origin: vec3f, reach: f32) -> bool {
    let bottom = bitcast<vec3f>(low.xyz) - origin;
    let top = bitcast<vec3f>(high.xyz) - origin;
    return low.w != 0u && meets_box(reciprocal, bottom, top, reach);
}

// The nearest hit at 0 < t < limit, or, with `any`, one of them. The limit 0 means no ray.
fn traverse(
    origin: vec3f,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    any: bool,
    invocation: u32,
) -> Hit {
    let lane = invocation & 7u;
    let reciprocal = finite_reciprocal(direction);
    var best = Hit(limit, NOTHING, vec3f(0.0));
    var lowest = NOTHING;
    // A lane that has what it wants sets this below 0, and meets nothing any more.
    var reach = select(limit, -1.0, limit <= 0.0);
    // The way of the packet, along which children are in order.
    let ahead = subgroupAdd(select(vec3f(0.0), direction, limit > 0.0));
    var stack = Stack();
    var link = select(0u, ROOT, subgroupAny(limit > 0.0));
    while link != 0u {
        // Down to the next leaf that some ray meets.
        while link != 0u && (link & 7u) == 0u {
            let words = textureLoad(node_table, table_place(link + lane), 0);
            let low0 = subgroupBroadcast(words, 0u);
            let high0 = subgroupBroadcast(words, 1u);
            let low1 = subgroupBroadcast(words, 2u);
            let high1 = subgroupBroadcast(words, 3u);
            let low2 = subgroupBroadcast(words, 4u);
            let high2 = subgroupBroadcast(words, 5u);
            let low3 = subgroupBroadcast(words, 6u);
            let high3 = subgroupBroadcast(words, 7u);
            // What is as near may be in a box that by rounding begins behind it.
            let far = reach * BEYOND;
            let met = subgroupOr(
                select(0u, 1u, meets_child(low0, high0, reciprocal, origin, far))
                | select(0u, 2u, meets_child(low1, high1, reciprocal, origin, far))
                | select(0u, 4u, meets_child(low2, high2, reciprocal, origin, far))
                | select(0u, 8u, meets_child(low3, high3, reciprocal, origin, far))
            );
            link = next_child(&stack, words, met, ahead, lane);
        }
        let end = link / 8u + link % 8u;
        for (var i = link / 8u; i < end; i++) {
            let loaded = textureLoad(triangle_table, table_place(3u * i + min(lane, 2u)), 0);
            let one = subgroupBroadcast(loaded, 0u);
            let two = subgroupBroadcast(loaded, 1u);
            let three = subgroupBroadcast(loaded, 2u);
            let index = two.w;
            let kind = three.w;
            let m = meet(
                bitcast<vec3f>(one.xyz), bitcast<vec3f>(two.xyz), bitcast<vec3f>(three.xyz),
                kind, origin, direction,
            );
            // At t = limit nothing counts, as `lowest` is set only by a hit.
            let tie = m.t == best.t && lowest != NOTHING && index < lowest;
            let counts = m.inside && m.t > 0.0 && reach > 0.0 && (m.t < best.t || tie);
            if counts && opaque(kind, index, m.weights) {
                best = Hit(m.t, i, m.weights);
                lowest = index;
                reach = select(m.t, -1.0, any);
            }
        }
        link = next_link(&stack, 0u, 0u, lane);
        if any && !subgroupAny(reach > 0.0) { break; }
    }
    return best;
}
