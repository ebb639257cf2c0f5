// How a diffuse surface scatters light: BRDF albedo / pi; directions by the cosine.

struct Scattered {
    direction: vec3f,
    // BRDF times cosine over the density.
    weight: vec3f,
    // Density of the direction by solid angle, over its cosine.
    density: f32,
}

// A direction about a unit normal; pdf cos / pi. The frame is that of Duff et al., "Building an
// Orthonormal Basis, Revisited", JCGT 2017.
fn cosine_hemisphere(n: vec3f, u: vec2f) -> vec3f {
    let s = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    let x = vec3f(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    let y = vec3f(b, s + n.y * n.y * a, -n.y);
    let r = sqrt(u.x);
    let turn = 2.0 * PI * u.y;
    return normalize(x * (r * cos(turn)) + y * (r * sin(turn)) + n * sqrt(1.0 - u.x));
}

// Towards a unit direction.
fn brdf(point: Point, albedo: vec3f, toward: vec3f) -> vec3f {
    return albedo / PI;
}

// The density with which `scatter` draws a unit direction, by solid angle, over its cosine.
fn scatter_density(point: Point, albedo: vec3f, toward: vec3f) -> f32 {
    return 1.0 / PI;
}

fn scatter(point: Point, albedo: vec3f, u: vec2f) -> Scattered {
    return Scattered(cosine_hemisphere(point.normal, u), albedo, 1.0 / PI);
}
