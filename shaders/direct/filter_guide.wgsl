// What the filter compares: the mean light of the like pixels among the 5 x 5 around each, and the
// variance of that mean, from the halves of the light samples. A pixel's own noise is little of it.

@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;
@group(0) @binding(18) var<storage, read_write> gathered: array<Gathered>;
@group(0) @binding(89) var<storage, read_write> local_means: array<vec2f>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.width * params.height { return; }
    let pixel = vec2i(pixel_of(id.x, 0u, params.width));
    let own = surface_at(pixel);
    var sum = vec2f(0.0);
    var count = 0.0;
    for (var i = 0; i < 25; i++) {
        let other = pixel + vec2i(i % 5 - 2, i / 5 - 2);
        let like = is_like(own, surface_at(other));
        let at = select(vec2u(pixel), vec2u(other), like);
        let light = mean_and_difference(irradiance[point_of(at, params.width)]);
        sum += select(vec2f(0.0), vec2f(light.x, light.y * light.y), like);
        count += f32(like);
    }
    count = max(count, 1.0);
    let at = u32(pixel.y) * params.width + u32(pixel.x);
    local_means[at] = vec2f(sum.x / count, sum.y / (count * count));
    gathered[at] = irradiance[id.x];
}
