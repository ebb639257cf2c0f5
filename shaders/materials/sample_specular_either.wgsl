// Specular surfaces are mirrors or glass.

fn sample_specular(point: Point, bsdf: Bsdf, direction: vec3f, u: f32) -> SpecularSample {
    if bsdf.kind == MIRROR { return at_mirror(point, bsdf, direction); }
    return at_glass(point, bsdf, direction, u);
}
