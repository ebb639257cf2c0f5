// Strata of all lights that have some extent: rectangles in the square from which the lights of a
// kind are drawn. So one choice is among lamps, emitting meshes and parts of the sky alike.

struct LightStratum {
    // The corner of the rectangle, and its extent.
    low: vec2f,
    extent: vec2f,
    kind: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(83) var<storage, read> light_strata: array<LightStratum>;

// A place in a stratum, uniform there by the measure of its kind.
fn sample_stratum(index: u32, point: Point, u: vec2f, offset: f32) -> LightSample {
    let stratum = light_strata[index];
    let at = stratum.low + stratum.extent * u;
    var light = sample_light(stratum.kind, point, at, offset);
    light.density /= stratum.extent.x * stratum.extent.y;
    return light;
}

// What a place gives unshadowed over its density, mean of the channels.
fn given(light: LightSample) -> f32 {
    let mean = (light.radiance.x + light.radiance.y + light.radiance.z) / 3.0;
    return select(0.0, mean * light.geometry / light.density, light.faces && light.density > 0.0);
}
