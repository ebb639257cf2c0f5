// Irradiance from lights of some extent, by a stratified sample set.

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let point = points[min(id.x, params.points - 1u)];
    let is = id.x < params.points && point.surface != NOTHING;
    let origin = offset_position(point, params.offset);
    let stream = hash(hash(params.first_block * 64u + id.x) + params.seed);
    var sum = Gathered();
    for (var i = params.first; i < params.first + params.count; i++) {
        let drawn = draw_light(point, i, stream);
        let light = drawn.light;
        let limit = select(0.0, light.limit, is && light.faces);
        let hit = traverse(origin, light.toward, limit, params.nodes, true, invocation);
        if limit > 0.0 && hit.triangle == NOTHING {
            let irradiance = light.radiance * (light.geometry * drawn.weight);
            sum += arriving(point, normalize(light.toward), irradiance);
        }
    }
    if is { irradiance[id.x] += sum * params.share; }
}
