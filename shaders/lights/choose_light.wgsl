// Draws a light by its probability.

// The light whose interval of probability holds u.
fn choose_light(u: f32, count: u32) -> u32 {
    var low = 0u;
    var high = count;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if lights[middle].before <= u { low = middle; } else { high = middle; }
    }
    return low;
}
