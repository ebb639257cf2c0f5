// A point sees what one row of the bit matrix sees.

alias Rows = u32;
alias Seen = u32;

fn load_seen(row: Rows, word: u32) -> Seen {
    return bits[word * params.rows + row];
}

// As if the row saw every VPL.
fn seen_from_everywhere(row: Rows) -> Seen {
    return 0xffffffffu;
}

// The value for a VPL that is seen, 0 for one that is not.
fn shown(value: vec2f, seen: Seen, bit: u32) -> vec2f {
    return select(vec2f(0.0), value, (seen & bit) != 0u);
}

// Moves later VPLs of the word to its head.
fn later(seen: Seen, count: u32) -> Seen {
    return seen >> count;
}

// The VPLs of the word that are seen at all.
fn seen_at_all(seen: Seen) -> u32 {
    return seen;
}
