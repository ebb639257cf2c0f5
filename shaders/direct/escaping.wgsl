// The environment, by rays that were drawn with this density by solid angle: the share that light
// samples leave them.

fn escaping(direction: vec3f, density: f32) -> vec3f {
    let radiance = background(direction);
    return radiance * mis_weight(max(density, 1e-30), params.sky_density * mean_of(radiance));
}
