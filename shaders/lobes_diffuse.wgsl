// What a point gathers where all surfaces are diffuse: irradiance; in w, the mean of the channels
// that the clamp removed.

alias Gathered = vec4f;

// Light from a unit direction that gives this irradiance.
fn arriving(point: Point, toward: vec3f, irradiance: vec3f) -> Gathered {
    return vec4f(irradiance, 0.0);
}

// The radiance that a point reflects of what it has gathered.
fn reflected(point: Point, albedo: vec3f, gathered: Gathered) -> vec3f {
    return gathered.rgb * albedo / PI;
}
