// Next-event estimation of paths: a place on the lights of some extent.

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let u = path_random(slot, paths[slot].stream, LIGHT_DIMENSIONS);
    let point = points[slot];
    let light = sample_light(0u, point, u, params.offset);
    // The next segment could have gone there, with the density of its direction.
    let density = scatter_density(point, albedo_of(slot, point), normalize(light.toward));
    let weight = mis_weight(light.density, light.geometry * density);
    let irradiance = light.radiance * (weight * light.geometry / light.density);
    receive(slot, light, irradiance, id.x < params.paths && light.faces, invocation);
}
