// What pixels have gathered, as light_to_table.wgsl left it.

@group(0) @binding(97) var light: texture_2d<u32>;

// That of a place in the order of pixels.
fn light_at(at: u32) -> Gathered {
    var sum = Gathered();
    for (var lobe = 0u; lobe < LOBES; lobe++) {
        let packed = textureLoad(light, table_place(LOBES * at + lobe), 0);
        sum += gathered_by(lobe, bitcast<vec4f>(packed));
    }
    return sum;
}
