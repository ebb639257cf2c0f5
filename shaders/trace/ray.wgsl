// Rays against boxes and triangles.

// A shape that rays hit: see TriangleRecord of src/gpu/layout.rs.
struct Triangle {
    a: vec3f,
    material: u32,
    b: vec3f,
    index: u32,
    c: vec3f,
    kind: u32,
}

struct Hit {
    t: f32,
    // In leaf order; NOTHING if there is no hit.
    triangle: u32,
    // Barycentric weights of the corners, or what else tells where it is.
    weights: vec3f,
}

// Finite stand-in for the reciprocal of a direction's zero component, and for "never".
const HUGE = 1e30;
// 1 + 2 gamma(3): widens the far side of a slab by the rounding of its distances. Ize,
// "Robust BVH Ray Traversal", JCGT 2013.
const WIDEN = 1.0000004;

fn finite_reciprocal(x: vec3f) -> vec3f {
    let huge = select(vec3f(HUGE), vec3f(-HUGE), x < vec3f(0.0));
    return select(huge, 1.0 / x, abs(x) > vec3f(1.0 / HUGE));
}

// Whether a ray meets a box at 0 <= t <= reach; the box is given relative to its origin.
fn meets_box(reciprocal: vec3f, low: vec3f, high: vec3f, reach: f32) -> bool {
    let t0 = low * reciprocal;
    let t1 = high * reciprocal;
    let first = min(t0, t1);
    let last = max(t0, t1);
    let near = max(max(first.x, first.y), max(first.z, 0.0));
    let far = min(last.x, min(last.y, last.z)) * WIDEN;
    return near <= min(far, reach);
}

// Where a ray meets a shape or its plane.
struct Meeting {
    t: f32,
    inside: bool,
    weights: vec3f,
}

// The rounding of the volume that a ray spans with an edge, over the largest coordinates of the
// edge and of the corners and the sum of the direction's: a product of two vectors has 2 terms of
// an edge and twice a corner, and 7 half ulps are lost on the way to the sum.
const VOLUME_ROUNDING = 1.7e-6;

// A triangle that a ray meets by that slack alone comes after one at the same place that it meets:
// a ray beside a wall's foot is to see the floor of its own side.
const BEYOND = 1.00001;

fn largest(v: vec3f) -> f32 {
    return max(v.x, max(v.y, v.z));
}

// The longest edge, by its coordinates.
fn longest_edge(a: vec3f, b: vec3f, c: vec3f) -> f32 {
    return largest(max(abs(c - b), max(abs(a - c), abs(b - a))));
}

// For edges and corners: what their volumes may be off, for a direction whose coordinates sum to 1.
fn volume_slack(a: vec3f, b: vec3f, c: vec3f) -> f32 {
    let corners = max(abs(a), max(abs(b), abs(c)));
    return VOLUME_ROUNDING * longest_edge(a, b, c) * largest(corners);
}

// The same of lines that are given by direction and moment, for rays from this origin: 8 half ulps
// of the moment, 6 of twice the origin.
fn line_slack(origin: vec3f) -> f32 {
    return 4.8e-7 + 7.2e-7 * largest(abs(origin));
}

// A ray with a triangle whose corners are given relative to its origin. From the volumes that the
// ray spans with the edges: an edge gives exactly opposite volumes to its two triangles, so that no
// ray slips between them. The Pluecker form of Woop, Benthin and Wald, "Watertight Ray/Triangle
// Intersection", JCGT 2013. At a vertex the volumes of all its edges are mere rounding, and any
// signs: what may be 0 counts as either. But not from the triangle's own plane, or as near to it as
// an edge may be off: along it all volumes are mere rounding, however far from the ray, or behind
// it, the triangle is.
fn intersect(a: vec3f, b: vec3f, c: vec3f, direction: vec3f) -> Meeting {
    let volumes = vec3f(
        dot(cross(c - b, c + b), direction),
        dot(cross(a - c, a + c), direction),
        dot(cross(b - a, b + a), direction),
    );
    let slack = volume_slack(a, b, c);
    let off = slack * dot(abs(direction), vec3f(1.0));
    let least = min(volumes.x, min(volumes.y, volumes.z));
    let most = max(volumes.x, max(volumes.y, volumes.z));
    let normal = cross(b - a, c - a);
    let speed = dot(normal, direction);
    let weights = weights_of(volumes);
    let height = dot(normal, a);
    let t = height / speed;
    let strict = least >= 0.0 || most <= 0.0;
    let may_be = (least >= -off || most <= off) && abs(height) > slack * longest_edge(a, b, c);
    let inside = (strict || may_be) && speed != 0.0 && weights.x >= 0.0;
    return Meeting(select(t * BEYOND, t, strict), inside, weights);
}

// The weights of a triangle's corners, none below 0; -1 if there are none.
fn weights_of(volumes: vec3f) -> vec3f {
    let side = select(-1.0, 1.0, volumes.x + volumes.y + volumes.z >= 0.0);
    let positive = max(side * volumes, vec3f(0.0));
    let sum = positive.x + positive.y + positive.z;
    return select(vec3f(-1.0), positive / sum, sum > 0.0);
}
