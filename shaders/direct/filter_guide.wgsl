// What the filter compares: the mean light of the like pixels among the 5 x 5 around each, and the
// variance of that mean, from the halves of the light samples. A pixel's own noise is little of it.

@group(0) @binding(17) var<storage, read> like_pixels: array<u32>;
// Means and half differences of pixels, and local means with their variances.
@group(0) @binding(94) var means: texture_2d<u32>;
@group(0) @binding(96) var packed_means: texture_storage_2d<rg32uint, write>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let pixel = vec2i(pixel_of(id.x, 0u, params.width));
    let like = like_pixels[id.x];
    var sum = vec2f(0.0);
    for (var i = 0; i < 25; i++) {
        let other = pixel + vec2i(i % 5 - 2, i / 5 - 2);
        let is = (like & (1u << u32(i))) != 0u;
        let at = place_of(vec2u(select(pixel, other, is)));
        let light = bitcast<vec2f>(textureLoad(means, table_place(at), 0).xy);
        sum += select(vec2f(0.0), vec2f(light.x, light.y * light.y), is);
    }
    let count = max(f32(countOneBits(like)), 1.0);
    let compared = bitcast<vec2u>(vec2f(sum.x / count, sum.y / (count * count)));
    let at = place_of(vec2u(pixel));
    textureStore(packed_means, table_place(at), vec4u(compared, 0u, 0u));
}
