// What a lobe reflects of light, and would reflect of the light that the clamp took.

// Means of the channels, over pi: what is clamped would be reflected as the light that is kept,
// whose noise may be below 0 where some is given back.
fn lobe_energy(reflectance: vec3f, gathered: vec4f) -> vec2f {
    let mean = (gathered.r + gathered.g + gathered.b) / 3.0;
    let kept = dot(gathered.rgb, reflectance) / 3.0;
    let plain = (reflectance.r + reflectance.g + reflectance.b) / 3.0;
    let least = min(reflectance.r, min(reflectance.g, reflectance.b));
    let most = max(reflectance.r, max(reflectance.g, reflectance.b));
    let share = select(plain, clamp(kept / mean, least, most), mean > 0.0);
    return vec2f(kept, gathered.w * share) / PI;
}
