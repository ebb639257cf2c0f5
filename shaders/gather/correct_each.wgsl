// Offers the VPLs of a word, each lane by itself.

fn offer_word(drawn: Drawn, x: Receiver, all: Seen, seen: Seen, word: u32, lane: u32) -> Drawn {
    var next = drawn;
    for (var i = 0u; i < 32u; i++) {
        let index = 32u * word + i;
        let light = pair_of(x, vpls[32u * params.matrix_word + index], all, 1u);
        next = offer(next, index, light, share_of(seen, 1u << i));
    }
    return next;
}
