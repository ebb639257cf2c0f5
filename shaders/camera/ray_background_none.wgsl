// Where a ray hits nothing there is no light.

fn seen_without_light(hit: Hit, seen: Point, direction: vec3f, width: f32) -> vec3f {
    if seen.surface == NOTHING { return vec3f(0.0); }
    return emitted_towards_ray(hit, seen, direction, width);
}
