// Area lights of one radiance, without holes.

// What the radiance of a light is multiplied by at a place.
fn light_emission_scale(light: u32, weights: vec3f) -> vec3f {
    return vec3f(1.0);
}
