// Lights without extent where they are many: points, spots and directional lights in one table, of
// which samples are drawn.

struct DeltaLight {
    // Where it is, or, of a light infinitely far away, the unit vector to there.
    place: vec3f,
    is_far: u32,
    // Where it shines in full; of a light far away, the irradiance of a surface across it.
    intensity: vec3f,
    // How fast a spot's ramp rises with the cosine to its axis from where it does not shine.
    slope: f32,
    axis: vec3f,
    cos_outer: f32,
}

@group(0) @binding(92) var<storage, read> delta_lights: array<DeltaLight>;

// Beyond its cone a spot gives nothing to a point, but it may to others around, for which a guide
// asks: as if it gave there these shares, far from the cone and beside it, within some cosine.
const BEYOND_CONE = 0.02;
const BESIDE_CONE = 0.2;
const BESIDE = 0.1;

// A light of a stratum, each as likely as the others.
fn sample_delta_light(stratum: LightStratum, point: Point, u: f32, offset: f32) -> LightSample {
    let count = stratum.extent.x;
    let light = delta_lights[u32(stratum.low.x + min(floor(u * count), count - 1.0))];
    let to_light = light.place - point.position;
    let square = dot(to_light, to_light);
    let distance = sqrt(square);
    let inside = dot(to_light, light.axis) / -distance - light.cos_outer;
    let ramp = saturate(inside * light.slope);
    let beyond = mix(BEYOND_CONE, BESIDE_CONE, saturate(1.0 + inside / BESIDE));
    let near = LightSample(
        light.place - offset_position(point, offset),
        1.0,
        dot(to_light, point.normal) > 0.0 && ramp > 0.0,
        light.intensity * select(beyond, ramp * ramp, ramp > 0.0),
        dot(to_light, point.normal) / (square * distance),
        1.0 / count,
    );
    let cosine = dot(light.place, point.normal);
    let far = LightSample(light.place, HUGE, cosine > 0.0, light.intensity, cosine, 1.0 / count);
    if light.is_far != 0u { return far; }
    return near;
}
