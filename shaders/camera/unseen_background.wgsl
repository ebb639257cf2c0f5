// A ray that hits nothing sees the environment.

fn seen_by_ray(seen: Point, near: vec3f) -> vec3f {
    return select(near, background(seen.normal), seen.surface == NOTHING);
}
