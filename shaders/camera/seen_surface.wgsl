// The surface that a ray or a pixel sees, in 16 bytes: where, and in a word which side of which
// material, with a normal on an octahedron, 10 bits a coordinate (Cigolle et al., "A Survey of
// Efficient Representations for Independent Unit Vectors", JCGT 2014).

struct SeenSurface {
    position: vec3f,
    normal: vec3f,
    // The lower 12 bits of the word; 0 if nothing is seen.
    code: u32,
}

// Materials beyond so many share codes; they would have to lie in one plane to be taken for another.
const MATERIAL_CODES = 2047u;

fn outwards(v: vec2f) -> vec2f {
    return select(vec2f(-1.0), vec2f(1.0), v >= vec2f(0.0));
}

fn pack_surface(point: Point) -> vec4u {
    if point.surface == NOTHING { return vec4u(0u); }
    let n = point.normal / dot(abs(point.normal), vec3f(1.0));
    let place = select((1.0 - abs(n.yx)) * outwards(n.xy), n.xy, n.z >= 0.0);
    let steps = vec2u(round(511.5 * (place + 1.0)));
    let code = 1u + (point.surface & ~FRONT) % MATERIAL_CODES
        + select(0u, 2048u, (point.surface & FRONT) != 0u);
    return vec4u(bitcast<vec3u>(point.position), code | (steps.x << 12u) | (steps.y << 22u));
}

fn unpack_surface(words: vec4u) -> SeenSurface {
    let steps = vec2u(words.w >> 12u, words.w >> 22u) & vec2u(1023u);
    let v = vec2f(steps) / 511.5 - 1.0;
    let z = 1.0 - abs(v.x) - abs(v.y);
    let unfolded = select((1.0 - abs(v.yx)) * outwards(v), v, z >= 0.0);
    let normal = normalize(vec3f(unfolded, z));
    return SeenSurface(bitcast<vec3f>(words.xyz), normal, words.w & 4095u);
}

// Whether one may have the light of the other.
fn alike(a: SeenSurface, b: SeenSurface) -> bool {
    let same = one_surface(a.normal, b.normal, b.position - a.position);
    return a.code == b.code && (same || a.code == 0u);
}
