// What comes back of the radiance of each visible point; in w, whether chance has chosen the way
// there.

@group(0) @binding(61) var<storage, read> throughputs: array<vec4f>;

fn kept_throughput(index: u32) -> vec4f {
    return throughputs[index];
}
