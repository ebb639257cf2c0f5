// What comes back of the radiance that paths see first.

@group(0) @binding(22) var<storage, read> paths: array<Path>;

fn kept_throughput(index: u32) -> vec4f {
    return vec4f(paths[index].throughput, 0.0);
}
