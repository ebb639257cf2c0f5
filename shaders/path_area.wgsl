// Next-event estimation of paths: a place on the area lights.

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let u = path_random(slot, paths[slot].stream, LIGHT_DIMENSIONS);
    let point = points[slot];
    let light = sample_area_light(point, u, params.lights, params.offset);
    let is = id.x < params.paths && light.faces;
    // The next segment could have met the place, with the density of its direction.
    let toward = light.end - shadow_origin(point);
    let density = scatter_density(point, albedo_of(slot, point), normalize(toward));
    let weight = mis_weight(light.density, light.geometry * density);
    let irradiance = light.radiance * (weight * light.geometry / light.density);
    receive(slot, toward, 1.0, irradiance, is, invocation);
}
