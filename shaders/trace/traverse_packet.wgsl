// Closest and any hit for a subgroup that goes through the hierarchy as one: as
// traverse.wgsl, for rays that are near each other. Nodes and triangles are loaded by eight
// lanes together, a word each. All lanes must call it together.

@group(0) @binding(1) var<storage, read> nodes: array<f32>;
@group(0) @binding(2) var<storage, read> triangles: array<f32>;

fn load_vector(at: u32) -> vec3f {
    return vec3f(triangles[at], triangles[at + 1u], triangles[at + 2u]);
}

fn load_triangle(i: u32) -> Triangle {
    let at = 12u * i;
    return Triangle(
        load_vector(at),
        bitcast<u32>(triangles[at + 3u]),
        load_vector(at + 4u),
        bitcast<u32>(triangles[at + 7u]),
        load_vector(at + 8u),
        bitcast<u32>(triangles[at + 11u]),
    );
}

// Whether some ray that is traced together with this one wants it.
fn some_ray(is: bool) -> bool {
    return subgroupAny(is);
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
    var at = 0u;
    while at < node_count {
        // Down to the next leaf that some ray meets.
        var leaf = 0u;
        while at < node_count {
            let loaded = nodes[8u * at + lane];
            let low = vec3f(
                subgroupBroadcast(loaded, 0u),
                subgroupBroadcast(loaded, 1u),
                subgroupBroadcast(loaded, 2u),
            );
            let high = vec3f(
                subgroupBroadcast(loaded, 4u),
                subgroupBroadcast(loaded, 5u),
                subgroupBroadcast(loaded, 6u),
            );
            let met = subgroupAny(meets_box(reciprocal, low - origin, high - origin, reach));
            leaf = select(0u, bitcast<u32>(subgroupBroadcast(loaded, 7u)), met);
            at = select(bitcast<u32>(subgroupBroadcast(loaded, 3u)), at + 1u, met);
            if leaf != 0u { break; }
        }
        let end = leaf / 8u + leaf % 8u;
        for (var i = leaf / 8u; i < end; i++) {
            let head = triangles[12u * i + lane];
            let tail = triangles[12u * i + 8u + (lane & 3u)];
            let index = bitcast<u32>(subgroupBroadcast(head, 7u));
            let a = vec3f(
                subgroupBroadcast(head, 0u),
                subgroupBroadcast(head, 1u),
                subgroupBroadcast(head, 2u),
            );
            let b = vec3f(
                subgroupBroadcast(head, 4u),
                subgroupBroadcast(head, 5u),
                subgroupBroadcast(head, 6u),
            );
            let c = vec3f(
                subgroupBroadcast(tail, 0u),
                subgroupBroadcast(tail, 1u),
                subgroupBroadcast(tail, 2u),
            );
            let kind = bitcast<u32>(subgroupBroadcast(tail, 3u));
            let m = meet(a, b, c, kind, origin, direction);
            // At t = limit nothing counts, as `lowest` is set only by a hit.
            let tie = m.t == best.t && lowest != NOTHING && index < lowest;
            let counts = m.inside && m.t > 0.0 && reach > 0.0 && (m.t < best.t || tie);
            if counts && opaque(kind, index, m.weights) {
                best = Hit(m.t, i, m.weights);
                lowest = index;
                reach = select(m.t, -1.0, any);
            }
        }
        if any && !subgroupAny(reach > 0.0) { break; }
    }
    return best;
}
