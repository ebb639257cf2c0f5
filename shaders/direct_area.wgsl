// Irradiance from the emitting triangles, by a stratified sample set: the light by its
// power, the position uniform on it.

struct AreaLight {
    corner: vec3f,
    before: f32,
    edge1: vec3f,
    probability: f32,
    edge2: vec3f,
    two_sided: u32,
    normal: vec3f,
    area: f32,
    radiance: vec3f,
    pad: f32,
}

@group(0) @binding(9) var<storage, read> lights: array<AreaLight>;

// The light whose interval of probability holds u.
fn choose(u: f32) -> u32 {
    var low = 0u;
    var high = params.lights;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if lights[middle].before <= u { low = middle; } else { high = middle; }
    }
    return low;
}

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let point = points[min(id.x, params.points - 1u)];
    let is = id.x < params.points && point.surface != NOTHING;
    let origin = point.position + params.offset * point.normal;
    let stream = hash(hash(params.first_block * 64u + id.x) + params.seed);
    var sum = vec3f(0.0);
    for (var i = params.first; i < params.first + params.count; i++) {
        // The i-th of the point's strata, and in it that of the sample of the pixel.
        var u = stratified(i * params.samples + params.sample, params.weight, stream);
        let light = lights[choose(u.x)];
        u.x = clamp((u.x - light.before) / light.probability, 0.0, 1.0);
        // The square root makes the density uniform and keeps strata whole.
        let root = sqrt(u.x);
        let on_light = light.corner + light.edge1 * (root * (1.0 - u.y)) + light.edge2 * (root * u.y);
        let to_light = on_light - point.position;
        let square = dot(to_light, to_light);
        let cosine = dot(to_light, point.normal);
        let facing = -dot(to_light, light.normal);
        let emitted = select(facing, abs(facing), light.two_sided != 0u);
        // The segment ends as far before the light as it starts before the point.
        let end = on_light + light.normal * (sign(facing) * params.offset);
        let limit = select(0.0, 1.0, is && cosine > 0.0 && emitted > 0.0);
        let hit = traverse(origin, end - origin, limit, params.nodes, true, invocation);
        if limit > 0.0 && hit.triangle == NOTHING {
            sum += light.radiance * (cosine * emitted * light.area / (square * square * light.probability));
        }
    }
    if is { irradiance[id.x] += vec4f(sum * params.share, 0.0); }
}
