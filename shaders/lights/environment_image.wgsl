// Radiance by an equirectangular image, whose colours are 9 bits a channel under an exponent of 5.
// The twin of src/scene/environment/radiance.rs.

// Radiance, width and height of the image, columns and rows of cells, a word unused; then for
// each row the probability of all rows before it, and 1; then for each row the same of its cells.
// Four words a texel.
@group(0) @binding(80) var environment: texture_2d<u32>;
@group(0) @binding(81) var environment_texels: texture_2d<u32>;

fn environment_word(at: u32) -> u32 {
    return textureLoad(environment, table_place(at / 4u), 0)[at % 4u];
}

// atan2 may be off by 1e-4 of its angle; a Newton step makes it as good as sine and cosine are.
fn angle_of(y: f32, x: f32) -> f32 {
    let angle = atan2(y, x);
    return angle + (y * cos(angle) - x * sin(angle)) / max(length(vec2f(x, y)), 1e-30);
}

// Where in the image a unit direction is, from its top left, in [0, 1]^2.
fn environment_place(direction: vec3f) -> vec2f {
    let turn = angle_of(direction.x, -direction.z);
    let polar = angle_of(length(direction.xz), direction.y);
    return vec2f(0.5 + turn / (2.0 * PI), polar / PI);
}

fn environment_radiance(place: vec2f) -> vec3f {
    let scale = textureLoad(environment, table_place(0u), 0);
    let size = vec2u(scale.w, textureLoad(environment, table_place(1u), 0).x);
    let at = min(vec2u(place * vec2f(size)), size - 1u);
    let index = at.y * size.x + at.x;
    let texel = textureLoad(environment_texels, table_place(index / 4u), 0)[index % 4u];
    // 2^(exponent - 24).
    let step = bitcast<f32>(((texel >> 27u) + 103u) << 23u);
    let channels = vec3f(vec3u(texel, texel >> 9u, texel >> 18u) & vec3u(511u));
    return bitcast<vec3f>(scale.xyz) * channels * step;
}

fn background(direction: vec3f) -> vec3f {
    return environment_radiance(environment_place(direction));
}
