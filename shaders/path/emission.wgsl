// Emission that the next segment of a path happens upon.

// From a point, in a direction that was drawn with this density by solid angle.
fn find_emission(
    slot: u32,
    carried: vec3f,
    start: Point,
    met: Hit,
    hit: Point,
    direction: vec3f,
    density: f32,
) {
    let material = materials[hit.surface & ~FRONT];
    let emits = (hit.surface & FRONT) != 0u || material.two_sided != 0u;
    let mean = (material.emission.x + material.emission.y + material.emission.z) / 3.0;
    // Densities by area of the two ways to get here: over the lights by power, and by direction.
    let drawn = params.light_density * mean * select(1.0, 2.0, material.two_sided != 0u);
    let by_direction = density * -dot(hit.normal, direction) / (hit.depth * hit.depth);
    if emits && drawn > 0.0 && by_direction > 0.0 {
        let emission = material.emission * emission_scale_of(slot);
        found(slot, carried * emission * mis_weight(by_direction, drawn));
    }
}
