// Where a point is seen from, which decides what a glossy surface shows. It takes the place of
// the depth, two coordinates of 16 bits: those of Cigolla et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 2014.

// Exactly -1 or 1.
fn signs(v: vec2f) -> vec2f {
    return select(vec2f(-1.0), vec2f(1.0), v >= vec2f(0.0));
}

// The point as a ray of this direction sees it.
fn with_view(point: Point, direction: vec3f) -> Point {
    let v = -direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    let folded = select((1.0 - abs(v.yx)) * signs(v.xy), v.xy, v.z >= 0.0);
    var seen = point;
    seen.depth = bitcast<f32>(pack2x16snorm(folded));
    return seen;
}

// The unit direction towards the viewer.
fn view_of(point: Point) -> vec3f {
    let v = unpack2x16snorm(bitcast<u32>(point.depth));
    let z = 1.0 - abs(v.x) - abs(v.y);
    let unfolded = select((1.0 - abs(v.yx)) * signs(v), v, z >= 0.0);
    return normalize(vec3f(unfolded, z));
}
