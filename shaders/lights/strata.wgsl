// Strata of all lights that samples are drawn of: of lights of some extent, rectangles in the square
// from which the lights of a kind are drawn; of lights without, runs of them. So one choice is among
// lamps, emitting meshes, parts of the sky and spots alike.

struct LightStratum {
    // The corner of the rectangle, and its extent; or in x the first light, and how many.
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

// What a place gives unshadowed over its density, mean of the channels.
fn given(light: LightSample) -> f32 {
    let mean = (light.radiance.x + light.radiance.y + light.radiance.z) / 3.0;
    return select(0.0, mean * light.geometry / light.density, light.faces && light.density > 0.0);
}
