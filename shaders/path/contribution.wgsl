// What light that reaches a vertex contributes to the pixel of its path.

// Of light from a unit direction that gives this irradiance.
fn contribution_of(slot: u32, point: Point, toward: vec3f, irradiance: vec3f) -> vec3f {
    return paths[slot].throughput * brdf(point, albedo_of(slot, point), toward) * irradiance;
}
