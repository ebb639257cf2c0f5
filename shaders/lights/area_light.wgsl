// Emitting triangles: the light by its power, a place on it as sample_triangle does.

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

// How many there are, in a texel; then five texels a light.
@group(0) @binding(9) var area_lights: texture_2d<u32>;

fn area_light_words(index: u32, row: u32) -> vec4u {
    return textureLoad(area_lights, table_place(1u + 5u * index + row), 0);
}

fn area_light(index: u32) -> AreaLight {
    let corner = bitcast<vec4f>(area_light_words(index, 0u));
    let edge1 = bitcast<vec4f>(area_light_words(index, 1u));
    let edge2 = area_light_words(index, 2u);
    let normal = bitcast<vec4f>(area_light_words(index, 3u));
    let radiance = bitcast<vec4f>(area_light_words(index, 4u));
    return AreaLight(
        corner.xyz, corner.w, edge1.xyz, edge1.w, bitcast<vec3f>(edge2.xyz), edge2.w,
        normal.xyz, normal.w, radiance.xyz, radiance.w,
    );
}

// A place on a light.
struct TriangleSample {
    // Of the corners.
    weights: vec3f,
    // In which it was drawn uniformly; 0 if it was on the area of the light.
    solid_angle: f32,
}

// Uniform on the light. The square root makes the density uniform and keeps strata whole.
fn uniform_on_triangle(light: AreaLight, u: vec2f) -> TriangleSample {
    let root = sqrt(u.x);
    return TriangleSample(vec3f(1.0 - root, root * (1.0 - u.y), root * u.y), 0.0);
}

// The light whose interval of probability holds u.
fn choose_area_light(u: f32) -> u32 {
    var low = 0u;
    var high = textureLoad(area_lights, vec2u(0u), 0).x;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        let before = bitcast<f32>(area_light_words(middle, 0u).w);
        if before <= u { low = middle; } else { high = middle; }
    }
    return low;
}

// A place on the lights.
fn sample_area_light(point: Point, at: vec2f, offset: f32) -> LightSample {
    var u = at;
    let index = choose_area_light(u.x);
    let light = area_light(index);
    u.x = clamp((u.x - light.before) / light.probability, 0.0, 1.0);
    let place = sample_triangle(point, light, u);
    let on_light =
        light.corner + light.edge1 * place.weights.y + light.edge2 * place.weights.z;
    let to_light = on_light - point.position;
    let square = dot(to_light, to_light);
    let cosine = dot(to_light, point.normal);
    let facing = -dot(to_light, light.normal);
    let emitted = select(facing, abs(facing), light.two_sided != 0u);
    let geometry = cosine * emitted / (square * square);
    // By area. From the same numbers as the geometry term, so that the weight of a place that is
    // seen edge-on, both of which are rounding there, is bounded by the solid angle.
    let by_angle = abs(facing) / max(square * sqrt(square) * place.solid_angle, 1e-37);
    let density = select(1.0 / light.area, max(by_angle, 1e-37), place.solid_angle > 0.0);
    // As far before the light as it starts before the point.
    let end = on_light + light.normal * (sign(facing) * offset);
    return LightSample(
        end - offset_position(point, offset),
        1.0,
        cosine > 0.0 && emitted > 0.0,
        light.radiance * light_emission_scale(index, place.weights),
        geometry,
        light.probability * density,
    );
}
