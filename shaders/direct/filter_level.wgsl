// A level of the filter of direct light: the mean over the 3 x 3 like pixels at some distance, by a
// tent, of those whose local means differ no more than their noise lets them. Dammertz et al.,
// "Edge-Avoiding A-Trous Wavelet Transform for fast Global Illumination Filtering", HPG 2010.

@group(0) @binding(18) var<storage, read> gathered: array<Gathered>;
@group(0) @binding(19) var<storage, read_write> combined: array<Gathered>;
@group(0) @binding(89) var<storage, read> local_means: array<vec2f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let pixel = vec2i(pixel_of(id.x, 0u, params.width));
    let at = u32(pixel.y) * params.width + u32(pixel.x);
    let own = surface_at(pixel);
    let mean = local_means[at];
    var sum = gathered[at] * 4.0;
    var weights = 4.0;
    for (var i = 0; i < 9; i++) {
        let way = vec2i(i % 3 - 1, i / 3 - 1);
        let other = pixel + way * i32(params.step);
        let like = is_like(own, surface_at(other)) && i != 4;
        let place = select(vec2u(pixel), vec2u(other), like);
        let from_at = place.y * params.width + place.x;
        let tap = local_means[from_at];
        let difference = mean.x - tap.x;
        let noise = params.tolerance * (mean.y + tap.y);
        let unlike = difference * difference / max(noise, 1e-30);
        let tent = f32((2 - abs(way.x)) * (2 - abs(way.y)));
        let weight = select(0.0, tent * exp(-min(unlike, 80.0)), like);
        sum += gathered[from_at] * weight;
        weights += weight;
    }
    combined[select(at, id.x, params.last != 0u)] = sum * (1.0 / weights);
}
