// The random numbers of paths: for each pair of dimensions of a pixel a sequence over all its
// samples, scrambled by itself.

const LIGHT_DIMENSIONS = 0u;
const BOUNCE_DIMENSIONS = 1u;
const ROULETTE_DIMENSIONS = 2u;
const DIMENSIONS_OF_VERTEX = 3u;

fn path_random(slot: u32, stream: u32, dimensions: u32) -> vec2f {
    let pair = params.bounce * DIMENSIONS_OF_VERTEX + dimensions;
    return scrambled(params.first_sample + slot % params.samples, hash(stream ^ hash(pair + 1u)));
}
