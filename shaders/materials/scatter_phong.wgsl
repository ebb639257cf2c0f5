// How a surface with a Phong lobe scatters light: BRDF albedo / pi + k_s (n + 2) / 2 pi cos^n;
// directions by the cosine, or by cos^n about the mirrored direction. The twin of
// src/render/materials/bsdf.rs.

struct BsdfSample {
    direction: vec3f,
    // BRDF times cosine over the density.
    weight: vec3f,
    // Density of the direction by solid angle, over its cosine.
    density: f32,
}

// Towards a unit direction.
fn brdf(point: Point, albedo: vec3f, toward: vec3f) -> vec3f {
    let receiver = receiver_of(point);
    let gloss = receiver.peak * lobe(receiver.mirrored, toward, receiver.shininess);
    return (albedo + specular_of(point) * gloss) / PI;
}

// The density with which `scatter` draws a unit direction, by solid angle, over its cosine.
fn scatter_density(point: Point, albedo: vec3f, toward: vec3f) -> f32 {
    let bsdf = bsdf_of(point);
    let gloss = lobe_density(mirrored_view(point), bsdf.parameter, toward);
    let cosine = max(dot(point.normal, toward), 1e-6);
    return (1.0 - bsdf.lobe_probability) / PI + bsdf.lobe_probability * gloss / cosine;
}

fn scatter(point: Point, albedo: vec3f, u: vec2f) -> BsdfSample {
    let bsdf = bsdf_of(point);
    // One number chooses, and what is left of it is uniform again.
    let glossy = u.x < bsdf.lobe_probability;
    let share = select(1.0 - bsdf.lobe_probability, bsdf.lobe_probability, glossy);
    let rest = vec2f(clamp((u.x - select(bsdf.lobe_probability, 0.0, glossy)) / share, 0.0, 1.0), u.y);
    let by_lobe = sample_lobe(mirrored_view(point), bsdf.parameter, rest);
    let direction = select(cosine_hemisphere(point.normal, rest), by_lobe, glossy);
    let density = scatter_density(point, albedo, direction);
    let weight = brdf(point, albedo, direction) / density;
    return BsdfSample(direction, select(vec3f(0.0), weight, dot(direction, point.normal) > 0.0), density);
}
