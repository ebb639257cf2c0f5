// How points gather and reflect light where some surfaces are glossy.

struct Receiver {
    point: Point,
    mirrored: vec3f,
    shininess: f32,
    // The lobe at its peak over 1 / pi: (n + 2) / 2; 0 without a lobe.
    peak: f32,
}

fn receiver_of(point: Point) -> Receiver {
    if point.surface == NOTHING { return Receiver(point, vec3f(0.0), 0.0, 0.0); }
    let bsdf = bsdf_of(point);
    let peak = select(0.0, 0.5 * bsdf.parameter + 1.0, bsdf.kind == PHONG);
    return Receiver(point, mirrored_view(point), bsdf.parameter, peak);
}

// Light from a unit direction that gives this irradiance.
fn arriving(point: Point, toward: vec3f, irradiance: vec3f) -> Gathered {
    let receiver = receiver_of(point);
    let gloss = receiver.peak * lobe(receiver.mirrored, toward, receiver.shininess);
    return Gathered(vec4f(irradiance, 0.0), vec4f(irradiance * gloss, 0.0));
}

// Phong's reflectance over that of a white diffuse surface; other bsdfs' are not gathered.
fn specular_of(point: Point) -> vec3f {
    let bsdf = bsdf_of(point);
    return select(vec3f(0.0), bsdf.specular, bsdf.kind == PHONG);
}

// The radiance that a point reflects of what it has gathered.
fn reflected(point: Point, albedo: vec3f, gathered: Gathered) -> vec3f {
    return (gathered[0].rgb * albedo + gathered[1].rgb * specular_of(point)) / PI;
}

// Means of the radiance that is reflected, and of that which the clamp took.
fn reflected_and_clamped(point: Point, albedo: vec3f, gathered: Gathered) -> vec2f {
    return lobe_energy(albedo, gathered[0]) + lobe_energy(specular_of(point), gathered[1]);
}
