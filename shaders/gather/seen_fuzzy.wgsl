// A point sees what up to four rows of the bit matrix see, each with its weight: fuzzy
// membership in the nearest clusters. Weights are per point and sum to 1.

struct Rows {
    rows: vec4u,
    weights: vec4f,
}

struct Seen {
    bits: vec4u,
    weights: vec4f,
}

@group(0) @binding(12) var<storage, read> cluster_of: array<vec4u>;
@group(0) @binding(15) var<storage, read> weight_of: array<vec4f>;

fn row_of(point: u32) -> Rows {
    return Rows(cluster_of[point], weight_of[point]);
}

fn load_seen(own: Rows, word: u32) -> Seen {
    let at = vec4u(word * params.rows) + own.rows;
    return Seen(vec4u(bits[at.x], bits[at.y], bits[at.z], bits[at.w]), own.weights);
}

// As if every row saw every VPL.
fn seen_from_everywhere(own: Rows) -> Seen {
    return Seen(vec4u(0xffffffffu), own.weights);
}

// The value times the share of the weights that see the VPL.
fn shown(value: vec2f, seen: Seen, bit: u32) -> vec2f {
    let share = select(vec4f(0.0), seen.weights, (seen.bits & vec4u(bit)) != vec4u(0u));
    return value * (share.x + share.y + share.z + share.w);
}

// Moves later VPLs of the word to its head.
fn later(seen: Seen, count: u32) -> Seen {
    return Seen(seen.bits >> vec4u(count), seen.weights);
}

// The VPLs of the word that are seen at all.
fn seen_at_all(seen: Seen) -> u32 {
    return seen.bits.x | seen.bits.y | seen.bits.z | seen.bits.w;
}
