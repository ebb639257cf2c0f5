// What a pixel has gathered goes to a table in the order of pixels, a texel a lobe.

@group(0) @binding(95) var stored_light: texture_storage_2d<rgba32uint, write>;

fn store_light(point: u32, at: u32, light: Gathered) {
    for (var lobe = 0u; lobe < LOBES; lobe++) {
        let packed = bitcast<vec4u>(light_of_lobe(light, lobe));
        textureStore(stored_light, table_place(LOBES * at + lobe), packed);
    }
}
