// The throughput of the specular chain to each visible point, as `store_throughput` left it; in w,
// whether chance has chosen between reflection and refraction on the way there.

@group(0) @binding(61) var<storage, read> throughputs: array<vec4f>;

fn stored_throughput(index: u32) -> vec4f {
    return throughputs[index];
}
