// How many light samples each visible point takes: more where few pixels around see the same surface,
// so that the filter can share little. From surfaces alone, never from samples, so that counts bring
// no bias.

@group(0) @binding(88) var<storage, read_write> ray_counts: array<u32>;

// Like pixels of the 5 x 5 around a point that takes the usual number, and at most how many times as
// many others take.
const LIKE = 18.0;
const MOST = 4.0;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let pixel = vec2i(pixel_of(id.x, 0u, params.width));
    let own = surface_at(pixel);
    var like = 0.0;
    for (var i = 0; i < 25; i++) {
        like += f32(is_like(own, surface_at(pixel + vec2i(i % 5 - 2, i / 5 - 2))));
    }
    let times = clamp(LIKE / max(like, 1.0), 1.0, MOST);
    ray_counts[id.x] = u32(round(f32(params.rays) * times));
}
