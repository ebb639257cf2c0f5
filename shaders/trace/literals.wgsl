// Closest and any hit of a ray by itself in a small scene: `meet_scene`, which
// src/render/kernels/literals.rs writes for the scene, puts the ray to every triangle. Lines are
// given by their direction and their moment (Pluecker coordinates), so that an edge costs two dot
// products and its two triangles share what comes of it: volumes that are exactly opposite.

struct Ray {
    origin: vec3f,
    direction: vec3f,
    moment: vec3f,
    // What volumes with edges of length 1 may be off.
    slack: f32,
}

// The nearest triangle so far, and the volumes that the ray spans with its edges.
struct Met {
    t: f32,
    triangle: u32,
    volumes: vec3f,
}

fn none(limit: f32) -> Met {
    return Met(limit, NOTHING, vec3f(0.0));
}

// The volume that a ray spans with a line.
fn edge(ray: Ray, direction: vec3f, moment: vec3f) -> f32 {
    return dot(ray.direction, moment) + dot(direction, ray.moment);
}

// Where a ray meets a plane, below 0 if it is parallel to it; and how far it starts from there.
struct Crossing {
    t: f32,
    rest: f32,
}

fn plane(ray: Ray, normal: vec3f, height: f32) -> Crossing {
    let rest = height - dot(normal, ray.origin);
    let speed = dot(normal, ray.direction);
    return Crossing(select(-1.0, rest / speed, speed != 0.0), abs(rest));
}

// Triangles come by index, so that of those at the same t the lowest stays. u, v and w are the
// volumes over the lengths of the edges. What may be 0 counts as of either side, but not from the
// triangle's own plane: see `intersect` in ray.wgsl.
fn nearer(
    met: Met,
    at: Crossing,
    u: f32,
    v: f32,
    w: f32,
    slack: f32,
    lengths: vec3f,
    triangle: u32,
) -> Met {
    let least = min(u, min(v, w));
    let most = max(u, max(v, w));
    let strict = least >= 0.0 || most <= 0.0;
    // Twice the slack is far from the plane.
    let may_be = (least >= -slack || most <= slack) && at.rest > 2.0 * slack;
    let some = least < 0.0 || most > 0.0;
    let t = select(at.t * BEYOND, at.t, strict);
    let is = (strict || may_be) && some && t > 0.0 && t < met.t;
    return Met(
        select(met.t, t, is),
        select(met.triangle, triangle, is),
        select(met.volumes, vec3f(u, v, w) * lengths, is),
    );
}

// Whether some ray that is traced together with this one wants it.
fn some_ray(is: bool) -> bool {
    return is;
}

// The nearest hit at 0 < t < limit; a caller that wants any has no use for its weights, which
// are then not computed. The limit 0 means no ray.
fn traverse(
    origin: vec3f,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    any: bool,
    invocation: u32,
) -> Hit {
    let slack = line_slack(origin) * dot(abs(direction), vec3f(1.0));
    let met = meet_scene(Ray(origin, direction, cross(origin, direction), slack), limit);
    return Hit(met.t, met.triangle, weights_of(met.volumes));
}
