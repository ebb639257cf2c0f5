// Emission that the next segment of a path happens upon, of triangles and of spheres.

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
    let sides = select(1.0, 2.0, material.two_sided != 0u);
    let mean = (material.emission.x + material.emission.y + material.emission.z) / 3.0;
    let shape = load_triangle(met.triangle);
    let is_sphere = (shape.kind & SPHERE) != 0u;
    // Densities of the two ways to get here, by area or, of spheres, by solid angle: over the
    // lights by power, and by direction.
    let radius = shape.b.x;
    let probability = params.solid_density * mean * sides * radius * radius;
    let cone = cone_of_sphere(start, shape.a, radius);
    let drawn = select(
        params.light_density * mean * sides,
        probability / (2.0 * PI * cone.width),
        is_sphere,
    );
    let by_area = density * -dot(hit.normal, direction) / (hit.depth * hit.depth);
    let by_direction = select(by_area, density, is_sphere);
    if emits && drawn > 0.0 && by_direction > 0.0 {
        let emission = material.emission * emission_scale_of(slot);
        found(slot, carried * emission * mis_weight(by_direction, drawn));
    }
}
