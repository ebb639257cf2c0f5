// What paths of bias compensation bring back of light that reaches their vertices.

// Of light from a unit direction that gives this irradiance.
fn brought_back(slot: u32, point: Point, toward: vec3f, irradiance: vec3f) -> vec3f {
    return gathered_back(slot, point, toward, arriving(point, toward, irradiance));
}
