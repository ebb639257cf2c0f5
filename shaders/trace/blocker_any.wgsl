// What blocks the segments of a packet: any shape, perhaps with holes.

struct Blocker {
    a: vec3f,
    b: vec3f,
    c: vec3f,
    kind: u32,
    index: u32,
    origin: vec3f,
}

// From what is loaded of a shape.
fn blocker(a: vec3f, b: vec3f, c: vec3f, kind: u32, index: u32, origin: vec3f) -> Blocker {
    return Blocker(a, b, c, kind, index, origin);
}

// Whether the segment from the origin along d (0 < t < 1) meets the shape.
fn blocks(k: Blocker, d: vec3f) -> bool {
    let m = meet(k.a, k.b, k.c, k.kind, k.origin, d);
    let between = m.inside && m.t > 0.0 && m.t < 1.0;
    return between && opaque(k.kind, k.index, m.weights);
}
