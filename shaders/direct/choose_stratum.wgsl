// Draws a stratum of the lights by the guide, from the row of a block of pixels.

struct ChosenStratum {
    stratum: u32,
    probability: f32,
    // How far into its interval of probability the number is, in [0, 1].
    rest: f32,
}

fn choose_stratum(first: u32, count: u32, at: f32) -> ChosenStratum {
    // Below the end of the last interval, whatever rounding made of it: what has no probability, as
    // the last may, is not drawn.
    let end = guide[first + count - 1u];
    let u = min(at, bitcast<f32>(bitcast<u32>(end) - 1u));
    var low = 0u;
    var high = count - 1u;
    while high > low {
        let middle = (low + high) / 2u;
        if guide[first + middle] <= u { low = middle + 1u; } else { high = middle; }
    }
    var before = 0.0;
    if low > 0u { before = guide[first + low - 1u]; }
    let probability = guide[first + low] - before;
    return ChosenStratum(low, probability, saturate((u - before) / probability));
}
