// What emits, by rays that were drawn with this density by solid angle: the share that light samples
// leave them.

@group(0) @binding(3) var<storage, read> materials: array<Material>;

fn emitted(start: Point, met: Hit, direction: vec3f, density: f32) -> vec3f {
    let hit = hit_point(met, direction);
    let material = materials[hit.surface & ~FRONT];
    let emits = (hit.surface & FRONT) != 0u || material.two_sided != 0u;
    let radiance = material.emission * emission_scale_at(met, hit, direction);
    // Densities by area.
    let drawn = params.area_density * mean_of(radiance);
    let by_lobe = density * -dot(hit.normal, direction) / (hit.depth * hit.depth);
    let weight = mis_weight(max(by_lobe, 1e-30), drawn);
    return select(vec3f(0.0), radiance * weight, emits && drawn > 0.0);
}
