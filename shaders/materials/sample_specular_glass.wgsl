// Specular surfaces are glass.

fn sample_specular(point: Point, bsdf: Bsdf, direction: vec3f, u: f32) -> SpecularSample {
    return at_glass(point, bsdf, direction, u);
}
