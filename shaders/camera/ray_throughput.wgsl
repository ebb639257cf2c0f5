// The throughputs of the specular chains of a pixel's first rays.

@group(0) @binding(102) var<storage, read_write> ray_throughputs: array<vec4u>;

fn store_ray_throughputs(index: u32, throughputs: vec4u) {
    ray_throughputs[index] = throughputs;
}

fn ray_throughput(index: u32, ray: u32) -> vec3f {
    return unpack_throughput(ray_throughputs[index][ray]);
}
