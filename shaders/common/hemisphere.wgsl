// Directions about an axis.

// An orthonormal frame about a unit axis: Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 2017.
fn frame_about(n: vec3f) -> mat3x3f {
    let s = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    return mat3x3f(
        vec3f(1.0 + s * n.x * n.x * a, s * b, -s * n.x),
        vec3f(b, s + n.y * n.y * a, -n.y),
        n,
    );
}

// A direction about a unit normal; pdf cos / pi.
fn cosine_hemisphere(n: vec3f, u: vec2f) -> vec3f {
    let r = sqrt(u.x);
    let turn = 2.0 * PI * u.y;
    return normalize(frame_about(n) * vec3f(r * cos(turn), r * sin(turn), sqrt(1.0 - u.x)));
}
