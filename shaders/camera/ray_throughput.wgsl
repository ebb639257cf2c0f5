// The throughputs of the specular chains of a pixel's first rays.

@group(0) @binding(106) var<storage, read_write> ray_throughputs: array<vec4f>;

fn store_ray_throughput(own: u32, ray: u32, throughput: vec3f) {
    ray_throughputs[MOST_FIRST * own + ray] = vec4f(throughput, 0.0);
}

fn ray_throughput(own: u32, ray: u32) -> vec3f {
    return ray_throughputs[MOST_FIRST * own + ray].rgb;
}
