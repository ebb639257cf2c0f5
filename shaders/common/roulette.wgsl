// Russian roulette: a path lives on with the probability of what it still carries, so that those
// that live carry about as much as at first. Always below 1, for walls that lose nothing. Not at
// the first bounces, which make most of the picture: to end paths there costs more than it saves.

const MOST_SURVIVAL = 0.999;
const FIRST_ROULETTE = 3u;

fn survival(throughput: vec3f) -> f32 {
    let most = max(throughput.x, max(throughput.y, throughput.z));
    return select(min(MOST_SURVIVAL, most), f32(most > 0.0), params.bounce < FIRST_ROULETTE);
}
