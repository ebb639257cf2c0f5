// The nearest hits of the rays of a beam, which start at one place and go nearly the same way: as
// traverse_packet.wgsl, but a node is tested once for the beam, and what a triangle's test asks of
// no ray is computed once. A subgroup holds eight beams or more; all lanes must call it together.

fn traverse_beam(origin: vec3f, beam: Beam, node_count: u32, invocation: u32) -> BeamHits {
    let lane = invocation & 7u;
    let r0 = finite_reciprocal(beam.d0);
    let r1 = finite_reciprocal(beam.d1);
    let r2 = finite_reciprocal(beam.d2);
    let r3 = finite_reciprocal(beam.d3);
    // Along an axis the distances to a plane are between those of the least and the greatest
    // reciprocal, whatever their signs.
    let least = min(min(r0, r1), min(r2, r3));
    let most = max(max(r0, r1), max(r2, r3));
    var h0 = Hit(beam.limits.x, NOTHING, vec3f(0.0));
    var h1 = Hit(beam.limits.y, NOTHING, vec3f(0.0));
    var h2 = Hit(beam.limits.z, NOTHING, vec3f(0.0));
    var h3 = Hit(beam.limits.w, NOTHING, vec3f(0.0));
    // Of what each ray has hit, the index: of those at the same distance the lowest stays.
    var lowest = vec4u(NOTHING);
    let is = any(beam.limits > vec4f(0.0));
    // The way of the packet, along which children are in order.
    let ahead = subgroupAdd(select(vec3f(0.0), beam.d0 + beam.d1 + beam.d2 + beam.d3, is));
    var stack = Stack();
    var link = select(0u, ROOT, subgroupAny(is));
    while link != 0u {
        // A beam without rays meets nothing.
        let reach = max(max(h0.t, h1.t), max(h2.t, h3.t));
        // What is as near may be in a box that by rounding begins behind it.
        let far = select(-1.0, reach * BEYOND, is);
        // Down to the next leaf that some beam meets.
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
            let met = subgroupOr(
                select(0u, 1u, beam_meets(low0, high0, least, most, origin, far))
                | select(0u, 2u, beam_meets(low1, high1, least, most, origin, far))
                | select(0u, 4u, beam_meets(low2, high2, least, most, origin, far))
                | select(0u, 8u, beam_meets(low3, high3, least, most, origin, far))
            );
            link = next_child(&stack, words, met, ahead, lane);
        }
        let end = link / 8u + link % 8u;
        for (var i = link / 8u; i < end; i++) {
            let loaded = textureLoad(triangle_table, table_place(3u * i + min(lane, 2u)), 0);
            let one = subgroupBroadcast(loaded, 0u);
            let two = subgroupBroadcast(loaded, 1u);
            let three = subgroupBroadcast(loaded, 2u);
            let a = bitcast<vec3f>(one.xyz);
            let b = bitcast<vec3f>(two.xyz);
            let c = bitcast<vec3f>(three.xyz);
            let index = two.w;
            let kind = three.w;
            let m0 = meet(a, b, c, kind, origin, beam.d0);
            let m1 = meet(a, b, c, kind, origin, beam.d1);
            let m2 = meet(a, b, c, kind, origin, beam.d2);
            let m3 = meet(a, b, c, kind, origin, beam.d3);
            let n0 = is_nearer(m0, h0, lowest.x, index) && opaque(kind, index, m0.weights);
            let n1 = is_nearer(m1, h1, lowest.y, index) && opaque(kind, index, m1.weights);
            let n2 = is_nearer(m2, h2, lowest.z, index) && opaque(kind, index, m2.weights);
            let n3 = is_nearer(m3, h3, lowest.w, index) && opaque(kind, index, m3.weights);
            h0 = nearer_hit(h0, m0.t, i, n0);
            h1 = nearer_hit(h1, m1.t, i, n1);
            h2 = nearer_hit(h2, m2.t, i, n2);
            h3 = nearer_hit(h3, m3.t, i, n3);
            lowest = select(lowest, vec4u(index), vec4<bool>(n0, n1, n2, n3));
        }
        link = next_link(&stack, 0u, 0u, lane);
    }
    return BeamHits(h0, h1, h2, h3);
}

// Whether a beam may meet a child, which these words hold, at 0 <= t <= reach.
fn beam_meets(
    low: vec4u,
    high: vec4u,
    least: vec3f,
    most: vec3f,
    origin: vec3f,
    reach: f32,
) -> bool {
    let bottom = bitcast<vec3f>(low.xyz) - origin;
    let top = bitcast<vec3f>(high.xyz) - origin;
    let near = min(min(bottom * least, bottom * most), min(top * least, top * most));
    let far = max(max(bottom * least, bottom * most), max(top * least, top * most));
    let first = max(max(near.x, near.y), max(near.z, 0.0));
    let last = min(far.x, min(far.y, far.z)) * WIDEN;
    return low.w != 0u && first <= min(last, reach);
}

// Whether a ray meets a shape before what it has hit. At its limit nothing counts, as `lowest` is
// set only by a hit; and a limit of 0 is before everything.
fn is_nearer(m: Meeting, hit: Hit, lowest: u32, index: u32) -> bool {
    let tie = m.t == hit.t && lowest != NOTHING && index < lowest;
    return m.inside && m.t > 0.0 && (m.t < hit.t || tie);
}

fn nearer_hit(hit: Hit, t: f32, triangle: u32, is: bool) -> Hit {
    return Hit(select(hit.t, t, is), select(hit.triangle, triangle, is), vec3f(0.0));
}

// Weights are computed once, of what a ray of a beam has hit.
fn with_weights(hit: Hit, origin: vec3f, direction: vec3f) -> Hit {
    if hit.triangle == NOTHING { return hit; }
    let shape = load_triangle(hit.triangle);
    let m = meet(shape.a, shape.b, shape.c, shape.kind, origin, direction);
    return Hit(hit.t, hit.triangle, m.weights);
}
