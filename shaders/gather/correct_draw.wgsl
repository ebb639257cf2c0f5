// Drawing the VPLs to which a point traces shadow rays of its own.

// How much VPLs count of which all rows of a point say the same: they may all be wrong where things
// touch.
const AGREED = 0.2;

// Four VPLs that are drawn by their weights from all that were offered, each by itself. Chao, "A general
// purpose unequal probability sampling plan", Biometrika 1982.
struct Drawn {
    random: vec4u,
    chosen: vec4u,
    weight: vec4f,
    // Of all that were offered.
    sum: f32,
}

// Offers a VPL that gives this light unshadowed, and that this share of the point's rows sees.
fn offer(drawn: Drawn, index: u32, light: Gathered, share: f32) -> Drawn {
    let disagreement = 2.0 * sqrt(max(share * (1.0 - share), 0.0));
    let weight = mean_and_difference(light).x * mix(AGREED, 1.0, disagreement);
    let sum = drawn.sum + weight;
    // A linear congruential generator (Knuth and Lewis), of which the high bits are used.
    let random = drawn.random * 1664525u + 1013904223u;
    let takes = vec4f(random >> vec4u(8u)) * sum < vec4f(weight * 16777216.0);
    return Drawn(
        random,
        select(drawn.chosen, vec4u(index), takes),
        select(drawn.weight, vec4f(weight), takes),
        sum,
    );
}

// The share of a point's rows that sees a VPL.
fn share_of(seen: Seen, bit: u32) -> f32 {
    return shown(vec2f(1.0), seen, bit).x;
}
