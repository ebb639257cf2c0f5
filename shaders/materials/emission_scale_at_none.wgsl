// Emission that no texture varies.

// What the emission where a ray has hit is multiplied by.
fn emission_scale_at(hit: Hit, point: Point, direction: vec3f) -> vec3f {
    return vec3f(1.0);
}
