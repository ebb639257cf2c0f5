// The emission of surfaces is that of their materials.

fn ray_emission_scale(hit: Hit, point: Point) -> vec3f {
    return vec3f(1.0);
}
