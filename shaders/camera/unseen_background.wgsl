// A ray that hits nothing sees the environment.

fn seen_without_light(hit: Hit, seen: Point) -> vec3f {
    if seen.surface == NOTHING { return background(seen.normal); }
    return emitted_towards_ray(hit, seen);
}
