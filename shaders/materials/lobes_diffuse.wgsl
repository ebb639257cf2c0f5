// How points gather and reflect light where all surfaces are diffuse.

alias Receiver = Point;

fn receiver_of(point: Point) -> Receiver {
    return point;
}

// Light from a unit direction that gives this irradiance.
fn arriving(point: Point, toward: vec3f, irradiance: vec3f) -> Gathered {
    return vec4f(irradiance, 0.0);
}

// The radiance that a point reflects of what it has gathered.
fn reflected(point: Point, albedo: vec3f, gathered: Gathered) -> vec3f {
    return gathered.rgb * albedo / PI;
}

// Means of the radiance that is reflected, and of that which the clamp took.
fn reflected_and_clamped(point: Point, albedo: vec3f, gathered: Gathered) -> vec2f {
    return lobe_energy(albedo, gathered);
}
