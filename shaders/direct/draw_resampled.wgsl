// The place on the lights that a shadow ray goes to: of several drawn by power, one by what it
// would give unshadowed, where lights are many and a point is near few of them. Talbot, Cline and
// Egbert, "Importance Resampling for Global Illumination", EGSR 2005.

struct Drawn {
    light: LightSample,
    // Of its unshadowed contribution in the sum over all shadow rays.
    weight: f32,
}

const CANDIDATES = 8u;

fn draw_light(point: Point, ray: u32, stream: u32) -> Drawn {
    let rays = u32(1.0 / params.share + 0.5);
    var chosen = LightSample();
    var given = 0.0;
    var sum = 0.0;
    // One number decides all: what is left of it after a choice is uniform again.
    var u = f32(hash(stream ^ hash(ray * params.samples + params.sample + 1u)) >> 8u) / 16777216.0;
    for (var i = 0u; i < CANDIDATES; i++) {
        // Strata of all candidates of all rays; those of a ray are spread over the lights.
        let index = (i * rays + ray) * params.samples + params.sample;
        let at = stratified(index, params.weight / f32(CANDIDATES), stream);
        let light = sample_light(point, at, params.lights, params.offset);
        let mean = (light.radiance.x + light.radiance.y + light.radiance.z) / 3.0;
        let gives = select(0.0, mean * light.geometry, light.faces);
        sum += gives / light.density;
        let share = select(0.0, gives / (light.density * sum), gives > 0.0);
        if u < share {
            chosen = light;
            given = gives;
            u = u / share;
        } else {
            u = (u - share) / max(1.0 - share, 1e-7);
        }
    }
    return Drawn(chosen, select(0.0, sum / (f32(CANDIDATES) * given), given > 0.0));
}
