// A ray that hits nothing sees the environment.

fn seen_without_light(hit: Hit, seen: Point, direction: vec3f, width: f32) -> vec3f {
    if seen.surface == NOTHING { return background(direction); }
    return emitted_towards_ray(hit, seen, direction, width);
}
