// Surfaces emit nothing.

fn emitted_towards_ray(hit: Hit, seen: Point, direction: vec3f, width: f32) -> vec3f {
    return vec3f(0.0);
}
