// What the strata of the lights give unshadowed to a block of pixels.

// Points of a block that are asked.
const ASKED = 8u;
// Points of other orientation are in the block, too: a cosine counts as this at least.
const LEAST_COSINE = 0.03;

fn given_about(point: Point, light: LightSample) -> f32 {
    let cosine = dot(normalize(light.toward), point.normal);
    let mean = (light.radiance.x + light.radiance.y + light.radiance.z) / 3.0;
    let upright = light.geometry / select(cosine, 1e-4, abs(cosine) < 1e-4);
    return mean * max(upright, 0.0) * max(cosine, LEAST_COSINE) / light.density;
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let block = group.x;
    for (var stratum = invocation; stratum < params.strata; stratum += 64u) {
        var sum = 0.0;
        for (var i = 0u; i < ASKED; i++) {
            // Every ninth: all columns and rows of the block.
            let point = points[block * 64u + (9u * i + 4u) % 64u];
            let u = fract(vec2f(0.5) + f32(i) * vec2f(0.7548777, 0.5698403));
            let light = sample_stratum(stratum, point, u, params.offset);
            sum += select(given_about(point, light), 0.0, point.surface == NOTHING);
        }
        unshadowed[block * params.strata + stratum] = sum;
    }
    let index = block * 64u + invocation;
    pilots[index] = NO_PILOT;
}
