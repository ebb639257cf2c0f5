// What light that reaches a vertex contributes to the visible point of its path.

// Of light from a unit direction that gives this irradiance.
fn contribution_of(slot: u32, point: Point, toward: vec3f, irradiance: vec3f) -> vec3f {
    return gathered_back(returning(slot, point), toward, arriving(point, toward, irradiance));
}
