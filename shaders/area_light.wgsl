// Emitting triangles: the light by its power, the position uniform on it.

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

// A place on the lights.
fn sample_light(point: Point, at: vec2f, light_count: u32, offset: f32) -> LightSample {
    var u = at;
    let index = choose_light(u.x, light_count);
    let light = lights[index];
    u.x = clamp((u.x - light.before) / light.probability, 0.0, 1.0);
    // The square root makes the density uniform and keeps strata whole.
    let root = sqrt(u.x);
    let on_light = light.corner + light.edge1 * (root * (1.0 - u.y)) + light.edge2 * (root * u.y);
    let weights = vec3f(1.0 - root, root * (1.0 - u.y), root * u.y);
    let to_light = on_light - point.position;
    let square = dot(to_light, to_light);
    let cosine = dot(to_light, point.normal);
    let facing = -dot(to_light, light.normal);
    let emitted = select(facing, abs(facing), light.two_sided != 0u);
    let geometry = cosine * emitted / (square * square);
    // As far before the light as it starts before the point.
    let end = on_light + light.normal * (sign(facing) * offset);
    return LightSample(
        end - light_origin(point, offset),
        1.0,
        cosine > 0.0 && emitted > 0.0,
        light.radiance * light_glow(index, weights),
        geometry,
        light.probability / light.area,
    );
}
