// Radiance that a surface emits towards the ray that has hit it.

@group(0) @binding(3) var<storage, read> materials: array<Material>;

fn emitted_towards_ray(hit: Hit, seen: Point, direction: vec3f, width: f32) -> vec3f {
    let index = seen.surface & ~FRONT;
    let emits = (seen.surface & FRONT) != 0u || materials[index].two_sided != 0u;
    let emission = materials[index].emission;
    if !emits || all(emission == vec3f(0.0)) { return vec3f(0.0); }
    return emission * ray_emission_scale(index, hit, seen, direction, width);
}
