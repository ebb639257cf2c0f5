// The direction from which a point is seen: rays start and end along it, and it decides what a
// glossy surface shows. It is stored in place of the depth, as two coordinates of 16 bits on an
// octahedron: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
// JCGT 2014.

// Exactly -1 or 1.
fn signs(v: vec2f) -> vec2f {
    return select(vec2f(-1.0), vec2f(1.0), v >= vec2f(0.0));
}

// The point with a way towards the viewer, of any length.
fn with_view_direction(point: Point, way: vec3f) -> Point {
    let v = way / (abs(way.x) + abs(way.y) + abs(way.z));
    let folded = select((1.0 - abs(v.yx)) * signs(v.xy), v.xy, v.z >= 0.0);
    var seen = point;
    seen.depth = bitcast<f32>(pack2x16snorm(folded));
    return seen;
}

// The unit direction towards the viewer.
fn view_direction(point: Point) -> vec3f {
    let v = unpack2x16snorm(bitcast<u32>(point.depth));
    let z = 1.0 - abs(v.x) - abs(v.y);
    let unfolded = select((1.0 - abs(v.yx)) * signs(v), v, z >= 0.0);
    return normalize(vec3f(unfolded, z));
}

// Where rays start and end, this far off the surface.
fn offset_position(point: Point, offset: f32) -> vec3f {
    let view = view_direction(point);
    return point.position + view * (offset / dot(view, point.normal));
}
