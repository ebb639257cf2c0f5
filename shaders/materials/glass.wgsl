// A smooth dielectric. The twin of `sample_specular` in src/render/materials/bsdf.rs.

// Fresnel's reflectance of unpolarised light under a cosine, at an index of refraction of what is
// beyond over that of what is before.
fn fresnel(cosine: f32, eta: f32) -> f32 {
    let square = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
    // Total reflection.
    if square <= 0.0 { return 1.0; }
    let beyond = sqrt(square);
    let across = (cosine - eta * beyond) / (cosine + eta * beyond);
    let along = (eta * cosine - beyond) / (eta * cosine + beyond);
    return 0.5 * (across * across + along * along);
}

// Reflected if u is below Fresnel's reflectance, else refracted.
fn at_glass(point: Point, bsdf: Bsdf, direction: vec3f, u: f32) -> SpecularSample {
    let cosine = -dot(direction, point.normal);
    let eta = select(1.0 / bsdf.parameter, bsdf.parameter, (point.surface & FRONT) != 0u);
    if u < fresnel(cosine, eta) {
        return SpecularSample(normalize(direction + 2.0 * cosine * point.normal), bsdf.specular, 1.0);
    }
    let beyond = sqrt(max(1.0 - (1.0 - cosine * cosine) / (eta * eta), 0.0));
    let refracted = normalize(direction / eta + (cosine / eta - beyond) * point.normal);
    // Radiance is denser where light is slower.
    return SpecularSample(refracted, bsdf.specular / (eta * eta), -1.0);
}
