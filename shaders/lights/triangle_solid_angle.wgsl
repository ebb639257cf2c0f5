// Samples an emitting triangle by solid angle: uniform in the directions that it fills, where it is
// near, so that 1/d² is in no weight; else uniform on it. Arvo, "Stratified Sampling of Spherical
// Triangles", SIGGRAPH 1995, as in Pharr, Jakob and Humphreys, Physically Based Rendering, 4th
// edition, 6.5.4.

// Triangles are near that fill this solid angle. f32 has no better than 1e-6 of it.
const NEAR = 0.2;
// The sum of the angles of a sliver is rounding: beyond this, relative, it is no measure.
const SOUND = 1e-3;
// The volume that a triangle spans with a point in its plane, over the product of their distances.
const FLAT = 1e-6;

fn sample_triangle(point: Point, light: AreaLight, u: vec2f) -> TriangleSample {
    let way = light.corner - point.position;
    let solid_angle = solid_angle_of(way, light.edge1, light.edge2);
    if solid_angle < NEAR { return uniform_on_triangle(light, u); }
    let a = normalize(way);
    let b = normalize(way + light.edge1);
    let c = normalize(way + light.edge2);
    let ab = normalize(cross(a, b));
    let bc = normalize(cross(b, c));
    let ca = normalize(cross(c, a));
    let angle = between(ab, -ca);
    let excess = angle + between(bc, -ab) + between(ca, -bc) - PI;
    if abs(excess - solid_angle) > SOUND * solid_angle { return uniform_on_triangle(light, u); }

    // The corner that cuts off the share u.x of the triangle, on the side from a to c.
    let share = u.x * excess + PI - angle;
    let s = sin(share);
    let t = cos(share);
    let p = t + cos(angle);
    let q = s - sin(angle) * dot(a, b);
    let over = (q * s + p * t) * sin(angle);
    let cosine = clamp((q + (q * t - p * s) * cos(angle)) / over, -1.0, 1.0);
    let corner = cosine * a + sqrt(1.0 - cosine * cosine) * normalize(across(c, a));
    // Along the arc from b to there.
    let fall = u.y * (1.0 - dot(corner, b));
    let direction =
        (1.0 - fall) * b + sqrt(max(fall * (2.0 - fall), 0.0)) * normalize(across(corner, b));

    // Where that meets the triangle.
    let h = cross(direction, light.edge2);
    let first = -dot(way, h) / dot(light.edge1, h);
    let second = -dot(direction, cross(way, light.edge1)) / dot(light.edge1, h);
    let y = clamp(first, 0.0, 1.0);
    let z = clamp(second, 0.0, 1.0 - y);
    return TriangleSample(vec3f(1.0 - y - z, y, z), solid_angle);
}

// Of a triangle by the way to its first corner and two edges: van Oosterom and Strackee, "The Solid
// Angle of a Plane Triangle", 1983. 0 in its plane, where there are no angles.
fn solid_angle_of(way: vec3f, edge1: vec3f, edge2: vec3f) -> f32 {
    let b = way + edge1;
    let c = way + edge2;
    let lengths = vec3f(length(way), length(b), length(c));
    let product = lengths.x * lengths.y * lengths.z;
    let volume = abs(dot(way, cross(edge1, edge2)));
    let cosines = product + dot(way, b) * lengths.z + dot(b, c) * lengths.x
        + dot(c, way) * lengths.y;
    return select(0.0, 2.0 * atan2(volume, cosines), volume > FLAT * product);
}

// The angle between unit vectors, without the loss of an arc cosine near 0 and π.
fn between(p: vec3f, q: vec3f) -> f32 {
    return 2.0 * atan2(length(p - q), length(p + q));
}

// What of a vector is across a unit vector.
fn across(v: vec3f, axis: vec3f) -> vec3f {
    return v - dot(v, axis) * axis;
}
