// Where a ray hits nothing there is no light.

fn seen_without_light(hit: Hit, seen: Point) -> vec3f {
    return emitted_towards_ray(hit, seen);
}
