// Surfaces emit nothing.

fn emitted_towards_ray(hit: Hit, point: Point) -> vec3f {
    return vec3f(0.0);
}
