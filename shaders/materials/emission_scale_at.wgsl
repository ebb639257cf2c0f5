// Emission that a texture may vary, where a ray has hit, for one that does not keep it.

// What the emission there is multiplied by.
fn emission_scale_at(hit: Hit, point: Point, direction: vec3f) -> vec3f {
    let used = material_textures[point.surface & ~FRONT].y;
    return textured(used, hit, point, direction, 0.0);
}
