// Strata of all lights that have some extent: rectangles in the square from which the lights of a
// kind are drawn. So one choice is among lamps, emitting meshes and parts of the sky alike.

struct LightStratum {
    // The corner of the rectangle, and its extent.
    low: vec2f,
    extent: vec2f,
    kind: u32,
}

// Two texels a stratum.
@group(0) @binding(83) var light_strata: texture_2d<u32>;

fn light_stratum(index: u32) -> LightStratum {
    let square = bitcast<vec4f>(textureLoad(light_strata, table_place(2u * index), 0));
    let kind = textureLoad(light_strata, table_place(2u * index + 1u), 0).x;
    return LightStratum(square.xy, square.zw, kind);
}

// A place in a stratum, uniform there by the measure of its kind.
fn sample_stratum(index: u32, point: Point, u: vec2f, offset: f32) -> LightSample {
    let stratum = light_stratum(index);
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
