// Area lights that textures vary, or cut holes into.

// Of each light: the triangle, and its textures of emission and of holes, plus one.
@group(0) @binding(46) var<storage, read> light_textures: array<vec4u>;

// What the radiance of a light is multiplied by at a place.
fn light_emission_scale(light: u32, weights: vec3f) -> vec3f {
    let used = light_textures[light];
    let uv = texture_coordinates(0u, used.x, weights);
    var glow = vec3f(1.0);
    if used.y != 0u { glow = sample_texture(used.y - 1u, uv).rgb; }
    if used.z != 0u && sample_texture(used.z - 1u, uv).a < 0.5 { glow = vec3f(0.0); }
    return glow;
}
