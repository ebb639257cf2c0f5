// Stores the throughput of the specular chain to each visible point; in w, whether chance has
// chosen between reflection and refraction on the way there.

@group(0) @binding(61) var<storage, read_write> throughputs: array<vec4f>;

fn store_throughput(index: u32, chain: SpecularChain) {
    throughputs[index] = vec4f(chain.throughput, select(0.0, 1.0, chain.chosen));
}
