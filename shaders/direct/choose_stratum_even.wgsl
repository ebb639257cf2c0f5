// Draws a stratum of the lights, all with the same probability.

struct ChosenStratum {
    stratum: u32,
    probability: f32,
    // How far into its interval of probability the number is, in [0, 1].
    rest: f32,
    // The share of its light that is thought to arrive.
    arriving: f32,
}

fn choose_stratum(block: u32, count: u32, at: f32) -> ChosenStratum {
    let place = at * f32(count);
    let stratum = min(u32(place), count - 1u);
    return ChosenStratum(stratum, 1.0 / f32(count), saturate(place - f32(stratum)), 1.0);
}
