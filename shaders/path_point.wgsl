// Next-event estimation of paths: one of the point lights.

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let point = points[slot];
    // The other coordinate of what an area light is drawn with: the two differ.
    let u = path_random(slot, paths[slot].stream, LIGHT_DIMENSIONS).y;
    let light = lights[choose_light(u, params.lights)];
    let to_light = light.position - point.position;
    let square = dot(to_light, to_light);
    let cosine = dot(to_light, point.normal);
    let irradiance = light.intensity * (cosine / (square * sqrt(square) * light.probability));
    let is = id.x < params.paths && cosine > 0.0;
    receive(slot, light.position - shadow_origin(point), 1.0, irradiance, is, invocation);
}
