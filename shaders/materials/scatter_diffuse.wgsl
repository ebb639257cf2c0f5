// How a diffuse surface scatters light: BRDF albedo / pi; directions by the cosine.

struct BsdfSample {
    direction: vec3f,
    // BRDF times cosine over the density.
    weight: vec3f,
    // Density of the direction by solid angle, over its cosine.
    density: f32,
}

// Towards a unit direction.
fn brdf(point: Point, albedo: vec3f, toward: vec3f) -> vec3f {
    return albedo / PI;
}

// The density with which `scatter` draws a unit direction, by solid angle, over its cosine.
fn scatter_density(point: Point, albedo: vec3f, toward: vec3f) -> f32 {
    return 1.0 / PI;
}

fn scatter(point: Point, albedo: vec3f, u: vec2f) -> BsdfSample {
    return BsdfSample(cosine_hemisphere(point.normal, u), albedo, 1.0 / PI);
}
