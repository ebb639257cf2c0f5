// A colour of any scale: a byte a channel under an exponent of as many bits (Ward, "Real Pixels",
// Graphics Gems II, 1991).

fn pack_radiance(radiance: vec3f) -> u32 {
    let brightest = max(radiance.x, max(radiance.y, radiance.z));
    let exponent = clamp((bitcast<u32>(brightest) >> 23u) & 255u, 8u, 253u);
    let steps = min(vec3u(radiance * bitcast<f32>((261u - exponent) << 23u)), vec3u(255u));
    return steps.x | (steps.y << 8u) | (steps.z << 16u) | (exponent << 24u);
}

fn unpack_radiance(packed: u32) -> vec3f {
    let steps = vec3u(packed, packed >> 8u, packed >> 16u) & vec3u(255u);
    return vec3f(steps) * bitcast<f32>(((packed >> 24u) - 7u) << 23u);
}
