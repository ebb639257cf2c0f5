// Nothing emits light, and there is none where a ray hits nothing.

struct RayEmission {
    sum: vec3f,
    low: f32,
    high: f32,
}

fn no_emission() -> RayEmission {
    return RayEmission(vec3f(0.0), 0.0, 0.0);
}

fn with_emission(emission: RayEmission, light: vec3f) -> RayEmission {
    return emission;
}

fn store_ray_emission(own: u32, emission: RayEmission) {}

fn stored_ray_emission(own: u32) -> RayEmission {
    return no_emission();
}
