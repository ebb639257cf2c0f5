// What emits, of triangles and of spheres, by rays that were drawn with this density by solid angle:
// the share that light samples leave them.

@group(0) @binding(3) var<storage, read> materials: array<Material>;

fn emitted(start: Point, met: Hit, direction: vec3f, density: f32) -> vec3f {
    let hit = hit_point(met, direction);
    let material = materials[hit.surface & ~FRONT];
    let emits = (hit.surface & FRONT) != 0u || material.two_sided != 0u;
    let radiance = material.emission * emission_scale_at(met, hit, direction);
    let shape = load_triangle(met.triangle);
    let is_sphere = (shape.kind & SPHERE) != 0u;
    // Densities by area or, of spheres, by solid angle.
    let radius = shape.b.x;
    let sides = select(1.0, 2.0, material.two_sided != 0u);
    let probability = params.solid_density * mean_of(material.emission) * sides * radius * radius;
    let cone = cone_of_sphere(start, shape.a, radius);
    let drawn = select(
        params.area_density * mean_of(radiance),
        probability / (2.0 * PI * cone.width),
        is_sphere,
    );
    let by_area = density * -dot(hit.normal, direction) / (hit.depth * hit.depth);
    let weight = mis_weight(max(select(by_area, density, is_sphere), 1e-30), drawn);
    return select(vec3f(0.0), radiance * weight, emits && drawn > 0.0);
}
