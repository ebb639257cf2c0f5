// Light that the first rays of a pixel see beside what surfaces reflect: its sum, and the least and
// the most that one ray sees in its brightest channel.

@group(0) @binding(100) var<storage, read_write> ray_emission: array<vec4u>;

struct RayEmission {
    sum: vec3f,
    low: f32,
    high: f32,
}

fn no_emission() -> RayEmission {
    return RayEmission(vec3f(0.0), HUGE, 0.0);
}

// With one ray more.
fn with_emission(emission: RayEmission, light: vec3f) -> RayEmission {
    let brightest = max(light.x, max(light.y, light.z));
    return RayEmission(
        emission.sum + light,
        min(emission.low, brightest),
        max(emission.high, brightest),
    );
}

// The least and the most as the upper halves of their floats.
fn store_ray_emission(own: u32, emission: RayEmission) {
    let range = (bitcast<u32>(emission.low) >> 16u) | (bitcast<u32>(emission.high) & 0xffff0000u);
    ray_emission[own] = vec4u(bitcast<vec3u>(emission.sum), range);
}

fn stored_ray_emission(own: u32) -> RayEmission {
    let words = ray_emission[own];
    let low = bitcast<f32>(words.w << 16u);
    return RayEmission(bitcast<vec3f>(words.xyz), low, bitcast<f32>(words.w & 0xffff0000u));
}
