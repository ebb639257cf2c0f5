// No mirrors or glass: every throughput of a camera ray is 1.

fn store_ray_throughput(own: u32, ray: u32, throughput: vec3f) {}

fn ray_throughput(own: u32, ray: u32) -> vec3f {
    return vec3f(1.0);
}
