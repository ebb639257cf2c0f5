// What comes back of the radiance of each visible point; in w, whether chance has chosen the way
// there.

@group(0) @binding(61) var<storage, read_write> throughputs: array<vec4f>;

fn keep_throughput(index: u32, sight: Sight) {
    throughputs[index] = vec4f(sight.throughput, select(0.0, 1.0, sight.chosen));
}
