// Next-event estimation of paths: one of the lights without extent.

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    // The other coordinate of what a light of some extent is drawn with: the two differ.
    let u = path_random(slot, paths[slot].stream, LIGHT_DIMENSIONS).y;
    let light = light_of(choose_light(u, params.lights), points[slot], params.offset);
    let irradiance = light.radiance * (light.geometry / light.density);
    receive(slot, light, irradiance, id.x < params.paths && light.faces, invocation);
}
