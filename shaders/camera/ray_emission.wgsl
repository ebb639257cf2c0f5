// Radiance that a surface emits towards the ray that has hit it; `materials` are declared where
// albedos are read or stored.

fn emitted_towards_ray(hit: Hit, point: Point) -> vec3f {
    if point.surface == NOTHING { return vec3f(0.0); }
    let material = materials[point.surface & ~FRONT];
    let emits = (point.surface & FRONT) != 0u || material.two_sided != 0u;
    return select(vec3f(0.0), material.emission * ray_emission_scale(hit, point), emits);
}
