// Russian roulette: a path lives on with the probability of what it still carries, so that those
// that live carry about as much as at first. Always below 1, for walls that lose nothing.

const MOST_SURVIVAL = 0.999;

fn survival(throughput: vec3f) -> f32 {
    return min(MOST_SURVIVAL, max(throughput.x, max(throughput.y, throughput.z)));
}
