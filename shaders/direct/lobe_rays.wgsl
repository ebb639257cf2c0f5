// Light of lamps and of the environment that rays in directions of the lobe of glossy points find:
// of what the lobe reflects, the share that light samples leave them. Veach and Guibas, "Optimally
// Combining Sampling Techniques for Monte Carlo Rendering", SIGGRAPH 1995.

// Keeps their random numbers apart from those of light samples.
const LOBE_STREAM = 0x6c6f6265u;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let index = min(id.x, params.points - 1u);
    let point = points[index];
    let receiver = receiver_of(point);
    let in_range = receiver.shininess >= params.least_shininess
        && receiver.shininess < params.most_shininess;
    let is = id.x < params.points && receiver.peak > 0.0 && in_range;
    let origin = offset_position(point, params.offset);
    let stream = hash(hash(params.first_block * 64u + id.x) + params.seed) ^ LOBE_STREAM;
    let rays = rays_of(index);
    let halves = min(rays, params.halves);
    var sum = Gathered();
    for (var ray = params.first; ray < params.first + params.count; ray++) {
        let wanted = is && ray < rays;
        if !some_ray(wanted) { break; }
        // Each half is stratified by itself, over all samples of the pixel.
        let half = ray % halves;
        let own = (rays + halves - 1u - half) / halves;
        let place = ray / halves * params.samples + params.sample;
        let toward =
            sample_lobe(receiver.mirrored, receiver.shininess, scrambled(place, hash(stream + half)));
        let cosine = dot(toward, point.normal);
        let limit = select(0.0, HUGE, wanted && cosine > 0.0);
        let hit = traverse(origin, toward, limit, params.nodes, false, invocation);
        let density = lobe_density(receiver.mirrored, receiver.shininess, toward);
        if limit > 0.0 {
            var radiance: vec3f;
            if hit.triangle == NOTHING {
                radiance = escaping(toward, density);
            } else {
                radiance = emitted(point, hit, toward, density);
            }
            // Lobe over that of a white diffuse surface, over the density.
            let weight = cosine * receiver.peak * 2.0 * PI / (receiver.shininess + 1.0);
            let arrived = gathered_by(1u, vec4f(radiance * (weight / f32(own * halves)), 0.0));
            sum += with_half_difference(arrived, select(0.5, -0.5, half == 1u) * f32(halves));
        }
    }
    if is { irradiance[id.x] += sum; }
}
