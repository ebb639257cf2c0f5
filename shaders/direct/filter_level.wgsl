// A level of the filter of direct light: the mean over the 3 x 3 like pixels at some distance, by a
// tent, of those whose local means differ no more than their noise lets them. Dammertz et al.,
// "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", HPG 2010.

@group(0) @binding(94) var means: texture_2d<u32>;

// A local mean and its variance.
fn mean_at(at: u32) -> vec2f {
    return bitcast<vec2f>(textureLoad(means, table_place(at), 0).xy);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let pixel = vec2i(pixel_of(id.x, 0u, params.width));
    let at = place_of(vec2u(pixel));
    let mean = mean_at(at);
    let taps = like_taps(id.x, pixel);
    var sum = light_at(at) * 4.0;
    var weights = 4.0;
    for (var i = 0; i < 9; i++) {
        let way = vec2i(i % 3 - 1, i / 3 - 1);
        let like = (taps & (1u << u32(i))) != 0u && i != 4;
        let from_at = place_of(vec2u(select(pixel, pixel + way * i32(params.step), like)));
        let tap = mean_at(from_at);
        let difference = mean.x - tap.x;
        let noise = params.tolerance * (mean.y + tap.y);
        let unlike = difference * difference / max(noise, 1e-30);
        let tent = f32((2 - abs(way.x)) * (2 - abs(way.y)));
        let weight = select(0.0, tent * exp(-min(unlike, 80.0)), like);
        sum += light_at(from_at) * weight;
        weights += weight;
    }
    store_light(id.x, at, sum * (1.0 / weights));
}
