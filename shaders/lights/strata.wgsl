// Strata of all lights that samples are drawn of: of lights of some extent, rectangles in the square
// from which the lights of a kind are drawn; of lights without, runs of them. So one choice is among
// lamps, emitting meshes, parts of the sky and spots alike.

struct LightStratum {
    // The corner of the rectangle, and its extent; or in x the first light, and how many.
    low: vec2f,
    extent: vec2f,
    kind: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(83) var<storage, read> light_strata: array<LightStratum>;

// What a place gives unshadowed over its density, mean of the channels.
fn given(light: LightSample) -> f32 {
    let mean = (light.radiance.x + light.radiance.y + light.radiance.z) / 3.0;
    return select(0.0, mean * light.geometry / light.density, light.faces && light.density > 0.0);
}
