// Four shadow rays from one origin in a small scene. `meet_scene`, which src/render/kernels/literals.rs
// writes for the scene, puts them to every triangle. The common origin makes most of the test the same
// for all.

struct Ray {
    origin: vec3f,
    // The four segments.
    ways: mat3x4f,
    // What their volumes with edges of length 1 may be off.
    slack: vec4f,
}

alias Met = vec4<bool>;

fn none(limit: f32) -> Met {
    return vec4<bool>(false);
}

// The volumes that the segments span with a line of this direction and moment.
fn edge(ray: Ray, direction: vec3f, moment: vec3f) -> vec4f {
    return ray.ways * (moment + cross(direction, ray.origin));
}

// Which segments go through a plane.
fn plane(ray: Ray, normal: vec3f, height: f32) -> vec4<bool> {
    let rest = height - dot(normal, ray.origin);
    let speed = ray.ways * normal;
    // 0 < rest / speed < 1
    return (rest * speed > vec4f(0.0)) & (vec4f(abs(rest)) < abs(speed));
}

// What may be 0 counts as of either side: see `intersect` in ray.wgsl. That it does so from the
// triangle's own plane as well, at worst blocks a ray along it.
fn nearer(
    met: Met,
    between: vec4<bool>,
    u: vec4f,
    v: vec4f,
    w: vec4f,
    slack: vec4f,
    lengths: vec3f,
    triangle: u32,
) -> Met {
    let one_side = (min(u, min(v, w)) >= -slack) | (max(u, max(v, w)) <= slack);
    return met | (between & one_side);
}

// An origin for each of four points.
fn origins(origin: vec3f) -> mat3x4f {
    return mat3x4f(vec4f(origin.x), vec4f(origin.y), vec4f(origin.z));
}
