// What paths from the camera bring back of light that reaches their vertices.

// Of light from a unit direction that gives this irradiance.
fn brought_back(slot: u32, point: Point, toward: vec3f, irradiance: vec3f) -> vec3f {
    return paths[slot].throughput * brdf(point, albedo_of(slot, point), toward) * irradiance;
}
