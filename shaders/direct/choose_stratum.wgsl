// Draws a stratum of the lights by the guide, from the row of a block of pixels.

// Of each block and stratum of the lights, its probability and all before it, and the share of its
// light that is thought to arrive.
@group(0) @binding(84) var guide: texture_2d<u32>;

struct ChosenStratum {
    stratum: u32,
    probability: f32,
    // How far into its interval of probability the number is, in [0, 1].
    rest: f32,
    // The share of its light that is thought to arrive.
    arriving: f32,
}

fn guide_entry(at: u32) -> vec2f {
    return bitcast<vec2f>(textureLoad(guide, table_place(at), 0).xy);
}

fn choose_stratum(block: u32, count: u32, at: f32) -> ChosenStratum {
    let first = block * count;
    // Below the end of the last interval, whatever rounding made of it: what has no probability, as
    // the last may, is not drawn.
    let end = guide_entry(first + count - 1u).x;
    let u = min(at, bitcast<f32>(bitcast<u32>(end) - 1u));
    var low = 0u;
    var high = count - 1u;
    while high > low {
        let middle = (low + high) / 2u;
        if guide_entry(first + middle).x <= u { low = middle + 1u; } else { high = middle; }
    }
    let before = select(0.0, guide_entry(first + max(low, 1u) - 1u).x, low > 0u);
    let own = guide_entry(first + low);
    let probability = own.x - before;
    return ChosenStratum(low, probability, saturate((u - before) / probability), own.y);
}
