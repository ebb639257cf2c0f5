// Irradiance from the point lights, each by one exact shadow ray.

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let point = points[min(id.x, params.points - 1u)];
    let is = id.x < params.points && point.surface != NOTHING;
    let origin = point.position + params.offset * point.normal;
    var sum = Gathered();
    for (var i = params.first; i < params.first + params.count; i++) {
        let light = lights[i];
        let to_light = light.position - point.position;
        let square = dot(to_light, to_light);
        let cosine = dot(to_light, point.normal);
        let limit = select(0.0, 1.0, is && cosine > 0.0);
        let d = light.position - origin;
        let hit = traverse(origin, d, limit, params.nodes, true, invocation);
        if limit > 0.0 && hit.triangle == NOTHING {
            let irradiance = light.intensity * (cosine / (square * sqrt(square)));
            sum += arriving(point, to_light / sqrt(square), irradiance);
        }
    }
    if is { irradiance[id.x] += sum; }
}
