// Specular surfaces are mirrors.

fn sample_specular(point: Point, bsdf: Bsdf, direction: vec3f, u: f32) -> SpecularSample {
    return at_mirror(point, bsdf, direction);
}
