// What blocks the segments of a packet: triangles, none of them with holes. The common origin
// makes most of the test the same for all.

// The plane of a triangle and its edges, relative to the origin of a packet.
struct Blocker {
    bc: vec3f,
    ca: vec3f,
    ab: vec3f,
    normal: vec3f,
    height: f32,
    // Of the volumes: see `volume_slack`.
    slack: f32,
}

// From what is loaded of a shape.
fn blocker(p: vec3f, q: vec3f, r: vec3f, kind: u32, index: u32, origin: vec3f) -> Blocker {
    let a = p - origin;
    let b = q - origin;
    let c = r - origin;
    let normal = cross(b - a, c - a);
    return Blocker(
        cross(c - b, c + b),
        cross(a - c, a + c),
        cross(b - a, b + a),
        normal,
        dot(normal, a),
        volume_slack(a, b, c),
    );
}

// Whether the segment from the origin along d (0 < t < 1) meets the triangle: `intersect` of
// ray.wgsl without its division.
fn blocks(k: Blocker, d: vec3f) -> bool {
    let u = dot(k.bc, d);
    let v = dot(k.ca, d);
    let w = dot(k.ab, d);
    let speed = dot(k.normal, d);
    let slack = k.slack * dot(abs(d), vec3f(1.0));
    let one_side = min(u, min(v, w)) >= -slack || max(u, max(v, w)) <= slack;
    // 0 < height / speed < 1
    let between = k.height * speed > 0.0 && abs(k.height) < abs(speed);
    return one_side && between;
}
