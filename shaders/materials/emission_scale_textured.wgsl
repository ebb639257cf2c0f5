// An emission that a texture may vary, as `keep_glow` left it.

@group(0) @binding(45) var<storage, read_write> glows: array<vec4f>;

// What the emission of the point of an index is multiplied by.
fn glow_of(index: u32) -> vec3f {
    return glows[index].rgb;
}
