// An emission that a texture may vary, as `store_emission_scale` left it.

@group(0) @binding(45) var<storage, read_write> emission_scales: array<vec4f>;

// What the emission of the point of an index is multiplied by.
fn emission_scale_of(index: u32) -> vec3f {
    return emission_scales[index].rgb;
}
