// Next-event estimation of paths: a place on the area lights.

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let u = path_random(slot, paths[slot].stream, LIGHT_DIMENSIONS);
    let light = sample_area_light(points[slot], u, params.lights, params.offset);
    let is = id.x < params.paths && light.faces;
    // The direction could have been drawn as well, if what it finds counts.
    let met = select(0.0, light.geometry / PI, params.light_density > 0.0);
    let weight = mis_weight(light.density, met) * light.geometry / light.density;
    receive(slot, light.end, light.radiance * weight, is, invocation);
}
