// Irradiance from lights of some extent: rays to strata of the lights that the guide chooses, one
// choice among all kinds. In w, half the difference of the two halves of the rays, mean of the
// channels: what the filter takes the noise for.

// A place on the lights: of a few that are drawn, one by what it is thought to give. Talbot, Cline and
// Egbert, "Importance Resampling for Global Illumination", EGSR 2005.
struct Drawn {
    light: LightSample,
    // The stratum that it is of.
    stratum: u32,
    // By which its irradiance is multiplied.
    weight: f32,
}

fn draw_light(
    point: Point,
    receiver: LightReceiver,
    block: u32,
    place: u32,
    all: u32,
    stream: u32,
) -> Drawn {
    var drawn: Drawn;
    var sum = 0.0;
    // One number decides all: what is left of it after a choice is uniform again.
    var decides = f32(hash(stream ^ hash(place + 1u)) >> 8u) / 16777216.0;
    for (var i = 0u; i < params.candidates; i++) {
        // Strata of all candidates of all rays; those of a ray are spread over the lights.
        let u = stratified(i * all + place, 1.0 / f32(params.candidates * all), stream);
        let choice = choose_stratum(block, params.lights, u.x);
        let light =
            sample_stratum(choice.stratum, point, vec2f(choice.rest, u.y), params.offset);
        let gives = given_to(receiver, light, choice.stratum) * choice.arriving;
        let weight = gives / choice.probability;
        sum += weight;
        let share = select(0.0, weight / sum, weight > 0.0);
        if decides < share {
            drawn = Drawn(light, choice.stratum, 1.0 / (light.density * gives));
            decides = decides / share;
        } else {
            decides = (decides - share) / max(1.0 - share, 1e-7);
        }
    }
    drawn.weight *= sum / f32(params.candidates);
    return drawn;
}

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let index = min(id.x, params.points - 1u);
    let point = points[index];
    let is = id.x < params.points && point.surface != NOTHING;
    let origin = offset_position(point, params.offset);
    let stream = hash(hash(params.first_block * 64u + id.x) + params.seed);
    let receiver = light_receiver(point);
    let rays = rays_of(index);
    let halves = min(rays, params.halves);
    var sum = Gathered();
    for (var ray = params.first; ray < params.first + params.count; ray++) {
        let wanted = is && ray < rays;
        if !some_ray(wanted) { break; }
        // Each half is stratified by itself, over all samples of the pixel.
        let half = ray % halves;
        let own = (rays + halves - 1u - half) / halves;
        let all = own * params.samples;
        let place = ray / halves * params.samples + params.sample;
        let drawn = draw_light(point, receiver, index / 64u, place, all, hash(stream + half));
        let light = drawn.light;
        let limit = select(0.0, light.limit, wanted && drawn.weight > 0.0);
        let hit = traverse(origin, light.toward, limit, params.nodes, true, invocation);
        if limit > 0.0 && hit.triangle == NOTHING {
            let weight = light.geometry * drawn.weight / f32(own * halves);
            let arrived = sample_arriving(point, receiver, light, drawn.stratum, light.radiance * weight);
            sum += with_half_difference(arrived, select(0.5, -0.5, half == 1u) * f32(halves));
        }
    }
    if is { irradiance[id.x] += sum; }
}
