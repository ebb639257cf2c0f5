// Each point by itself: the plain twin of shade_cooperative.wgsl, for adapters without wide
// subgroups.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    let at = params.first_point + id.x;
    let receiver = receiver_of(points[at]);
    let row = row_of(at);
    var total = Gathered();
    for (var word = 0u; word < params.words; word++) {
        let seen = load_seen(row, word);
        var left = seen_at_all(seen);
        // A sum a word, then the sum of those, keeps rounding small over many VPLs.
        var sum = Gathered();
        while left != 0u {
            let index = firstTrailingBit(left);
            let vpl = vpls[32u * (params.matrix_word + word) + index];
            left &= left - 1u;
            sum += pair_of(receiver, vpl, seen, 1u << index);
        }
        total += sum;
    }
    irradiance[at] += total;
}
