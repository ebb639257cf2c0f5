// The throughput of the specular chain from the camera to the first vertex of each path.

@group(0) @binding(22) var<storage, read> paths: array<Path>;

fn stored_throughput(index: u32) -> vec4f {
    return vec4f(paths[index].throughput, 0.0);
}
