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

// Means of the radiance that is reflected, and of that which the clamp removed: it would be
// reflected as the light that is kept, whose noise may be below 0 where some is given back.
fn kept_and_removed(point: Point, albedo: vec3f, gathered: Gathered) -> vec2f {
    let mean = (gathered.r + gathered.g + gathered.b) / 3.0;
    let kept = dot(gathered.rgb, albedo) / (3.0 * PI);
    let plain = (albedo.r + albedo.g + albedo.b) / (3.0 * PI);
    let least = min(albedo.r, min(albedo.g, albedo.b)) / PI;
    let most = max(albedo.r, max(albedo.g, albedo.b)) / PI;
    let share = select(plain, clamp(kept / mean, least, most), mean > 0.0);
    return vec2f(kept, gathered.w * share);
}
