// The nearest hits of the four rays of a beam, which start at one place and go nearly the same
// way: as traverse_packet.wgsl, but a node is tested once for the beam, and what a triangle's test
// asks of no ray is computed once. A subgroup holds eight beams or more; all lanes must call it
// together.

// The limit 0 means no ray.
fn traverse_beam(
    origin: vec3f,
    directions: array<vec3f, 4>,
    limits: vec4f,
    node_count: u32,
    invocation: u32,
) -> array<Hit, 4> {
    let lane = invocation & 7u;
    let d0 = directions[0];
    let d1 = directions[1];
    let d2 = directions[2];
    let d3 = directions[3];
    let r0 = finite_reciprocal(d0);
    let r1 = finite_reciprocal(d1);
    let r2 = finite_reciprocal(d2);
    let r3 = finite_reciprocal(d3);
    // Along an axis the distances to a plane are between those of the least and the greatest
    // reciprocal, whatever their signs.
    let least = min(min(r0, r1), min(r2, r3));
    let most = max(max(r0, r1), max(r2, r3));
    var h0 = Hit(limits.x, NOTHING, vec3f(0.0));
    var h1 = Hit(limits.y, NOTHING, vec3f(0.0));
    var h2 = Hit(limits.z, NOTHING, vec3f(0.0));
    var h3 = Hit(limits.w, NOTHING, vec3f(0.0));
    // Of what each ray has hit, the index: of those at the same distance the lowest stays.
    var lowest = vec4u(NOTHING);
    var at = select(node_count, 0u, subgroupAny(any(limits > vec4f(0.0))));
    while at < node_count {
        // Down to the next leaf that some beam meets. A beam without rays reaches nothing.
        let reach = max(max(h0.t, h1.t), max(h2.t, h3.t));
        let wanted = select(-1.0, reach, reach > 0.0);
        var leaf = 0u;
        while at < node_count {
            let loaded = nodes[8u * at + lane];
            let low = vec3f(
                subgroupBroadcast(loaded, 0u),
                subgroupBroadcast(loaded, 1u),
                subgroupBroadcast(loaded, 2u),
            ) - origin;
            let high = vec3f(
                subgroupBroadcast(loaded, 4u),
                subgroupBroadcast(loaded, 5u),
                subgroupBroadcast(loaded, 6u),
            ) - origin;
            let near = min(min(low * least, low * most), min(high * least, high * most));
            let far = max(max(low * least, low * most), max(high * least, high * most));
            let first = max(max(near.x, near.y), max(near.z, 0.0));
            let last = min(far.x, min(far.y, far.z)) * WIDEN;
            let met = subgroupAny(first <= min(last, wanted));
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
            let m0 = meet(a, b, c, kind, origin, d0);
            let m1 = meet(a, b, c, kind, origin, d1);
            let m2 = meet(a, b, c, kind, origin, d2);
            let m3 = meet(a, b, c, kind, origin, d3);
            let n0 = is_nearer(m0, h0, lowest.x, index) && opaque(kind, index, m0.weights);
            let n1 = is_nearer(m1, h1, lowest.y, index) && opaque(kind, index, m1.weights);
            let n2 = is_nearer(m2, h2, lowest.z, index) && opaque(kind, index, m2.weights);
            let n3 = is_nearer(m3, h3, lowest.w, index) && opaque(kind, index, m3.weights);
            h0 = nearer(h0, m0.t, i, n0);
            h1 = nearer(h1, m1.t, i, n1);
            h2 = nearer(h2, m2.t, i, n2);
            h3 = nearer(h3, m3.t, i, n3);
            lowest = select(lowest, vec4u(index), vec4<bool>(n0, n1, n2, n3));
        }
    }
    return array<Hit, 4>(
        with_weights(h0, origin, d0),
        with_weights(h1, origin, d1),
        with_weights(h2, origin, d2),
        with_weights(h3, origin, d3),
    );
}

// Whether a ray meets a shape before what it has hit. At its limit nothing counts, as `lowest` is
// set only by a hit; and a limit of 0 is before everything.
fn is_nearer(m: Meeting, hit: Hit, lowest: u32, index: u32) -> bool {
    let tie = m.t == hit.t && lowest != NOTHING && index < lowest;
    return m.inside && m.t > 0.0 && (m.t < hit.t || tie);
}

fn nearer(hit: Hit, t: f32, triangle: u32, is: bool) -> Hit {
    return Hit(select(hit.t, t, is), select(hit.triangle, triangle, is), vec3f(0.0));
}

// Weights are computed once, of what has been hit.
fn with_weights(hit: Hit, origin: vec3f, direction: vec3f) -> Hit {
    if hit.triangle == NOTHING { return hit; }
    let shape = load_triangle(hit.triangle);
    let m = meet(shape.a, shape.b, shape.c, shape.kind, origin, direction);
    return Hit(hit.t, hit.triangle, m.weights);
}
