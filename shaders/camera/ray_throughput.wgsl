// The throughputs of the specular chains of a pixel's first rays: 9 bits a channel under an exponent
// of 5.

@group(0) @binding(106) var<storage, read_write> ray_throughputs: array<vec4u>;

fn pack_throughput(throughput: vec3f) -> u32 {
    let most = max(max(throughput.x, throughput.y), max(throughput.z, 1e-4));
    let exponent = clamp(i32(floor(log2(most))) + 1, -15, 16);
    let steps = min(vec3u(round(throughput * exp2(f32(9 - exponent)))), vec3u(511u));
    return steps.x | (steps.y << 9u) | (steps.z << 18u) | (u32(exponent + 15) << 27u);
}

fn unpack_throughput(packed: u32) -> vec3f {
    let steps = vec3u(packed, packed >> 9u, packed >> 18u) & vec3u(511u);
    return vec3f(steps) * exp2(f32(i32(packed >> 27u) - 24));
}

fn store_ray_throughputs(own: u32, throughputs: vec4u) {
    ray_throughputs[own] = throughputs;
}

fn ray_throughput(own: u32, ray: u32) -> vec3f {
    return unpack_throughput(ray_throughputs[own][ray]);
}
