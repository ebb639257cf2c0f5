// The nearest hits of the rays of a beam, one ray after the other: the plain twin of
// beam_packet.wgsl.

fn traverse_beam(origin: vec3f, beam: Beam, node_count: u32, invocation: u32) -> BeamHits {
    let none = Hit(0.0, NOTHING, vec3f(0.0));
    var hits = BeamHits(none, none, none, none);
    // No constant, as drivers unroll loops whose length they know, and compile every copy of a traversal.
    let rays = select(BEAM_RAYS, 0u, all(beam.limits == vec4f(0.0)));
    for (var i = 0u; i < rays; i++) {
        let direction = beam_direction(beam, i);
        let hit = traverse(origin, direction, beam.limits[i], node_count, false, invocation);
        if i == 0u { hits.h0 = hit; }
        if i == 1u { hits.h1 = hit; }
        if i == 2u { hits.h2 = hit; }
        if i == 3u { hits.h3 = hit; }
    }
    return hits;
}

// A ray by itself has found its weights.
fn with_weights(hit: Hit, origin: vec3f, direction: vec3f) -> Hit {
    return hit;
}
