// Emitting spheres: the light by its power, a direction uniform in the cone that it fills, or, from
// inside of it, in all directions.

struct SphereLight {
    center: vec3f,
    radius: f32,
    radiance: vec3f,
    two_sided: u32,
    before: f32,
    probability: f32,
    pad0: u32,
    pad1: u32,
}

// How many there are, in a texel; then three texels a light.
@group(0) @binding(82) var sphere_lights: texture_2d<u32>;

fn sphere_light_words(index: u32, row: u32) -> vec4u {
    return textureLoad(sphere_lights, table_place(1u + 3u * index + row), 0);
}

fn sphere_light(index: u32) -> SphereLight {
    let place = bitcast<vec4f>(sphere_light_words(index, 0u));
    let emission = sphere_light_words(index, 1u);
    let choice = bitcast<vec4f>(sphere_light_words(index, 2u));
    return SphereLight(
        place.xyz, place.w, bitcast<vec3f>(emission.xyz), emission.w, choice.x, choice.y, 0u, 0u,
    );
}

// The light whose interval of probability holds u.
fn choose_sphere_light(u: f32) -> u32 {
    var low = 0u;
    var high = textureLoad(sphere_lights, vec2u(0u), 0).x;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        let before = bitcast<f32>(sphere_light_words(middle, 2u).x);
        if before <= u { low = middle; } else { high = middle; }
    }
    return low;
}

// A direction to the lights; densities are by solid angle.
fn sample_sphere_light(point: Point, at: vec2f, offset: f32) -> LightSample {
    var u = at;
    let light = sphere_light(choose_sphere_light(u.x));
    u.x = clamp((u.x - light.before) / light.probability, 0.0, 1.0);
    let cone = cone_of_sphere(point, light.center, light.radius);
    let between = light.center - point.position;
    let distance = length(between);
    // The cosine with the axis is 1 - fall: kept apart, as it is near 0 for a light far away.
    let fall = u.x * cone.width;
    let sine = sqrt(max(fall * (2.0 - fall), 0.0));
    let turn = 2.0 * PI * u.y;
    let axis = select(vec3f(0.0, 0.0, 1.0), between / distance, distance > 0.0);
    let about = vec3f(sine * cos(turn), sine * sin(turn), 1.0 - fall);
    let direction = normalize(frame_about(axis) * about);
    let along = dot(between, direction);
    let across = between - along * direction;
    let half_chord = sqrt(max(light.radius * light.radius - dot(across, across), 0.0));
    let t = along + select(-half_chord, half_chord, cone.inside);
    let on_light = point.position + t * direction;
    let outward = normalize(on_light - light.center);
    // As far before the light as it starts before the point.
    let end = on_light + outward * select(offset, -offset, cone.inside);
    let cosine = dot(direction, point.normal);
    return LightSample(
        end - offset_position(point, offset),
        1.0,
        cosine > 0.0 && t > 0.0 && (!cone.inside || light.two_sided != 0u),
        light.radiance,
        cosine,
        light.probability / (2.0 * PI * cone.width),
    );
}
