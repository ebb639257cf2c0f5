// How many light samples each visible point takes: more where few pixels around see the same surface,
// so that the filter can share little. From surfaces alone, never from samples, so that counts bring
// no bias.

@group(0) @binding(88) var<storage, read_write> ray_counts: array<u32>;
// Of each point, a bit for each of the 5 x 5 pixels around that sees the same surface, row by row.
@group(0) @binding(17) var<storage, read_write> like_pixels: array<u32>;

// Like pixels of a point that takes the usual number, and at most how many times as many others take.
const LIKE = 18.0;
const MOST = 4.0;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let pixel = vec2i(pixel_of(id.x, 0u, params.width));
    let own = surface_at(pixel);
    var like = 0u;
    for (var i = 0; i < 25; i++) {
        let other = surface_at(pixel + vec2i(i % 5 - 2, i / 5 - 2));
        like |= u32(is_like(own, other)) << u32(i);
    }
    let times = clamp(LIKE / max(f32(countOneBits(like)), 1.0), 1.0, MOST);
    ray_counts[id.x] = u32(round(f32(params.rays) * times));
    like_pixels[id.x] = like;
}
