// What the strata of the lights give unshadowed to a block of pixels.

@group(0) @binding(4) var<storage, read> points: array<Point>;
// Of each block and stratum of the lights, what it gives unshadowed.
@group(0) @binding(86) var<storage, read_write> unshadowed: array<f32>;

// Points of a block that are asked.
const ASKED = 4u;
// Others may face elsewhere: a cosine counts as this at least, in blocks of one orientation and in
// others.
const LEAST_COSINE = vec2f(0.02, 0.2);
const ONE_ORIENTATION = 0.99;

var<workgroup> uneven: atomic<u32>;
// For each point of the block, itself or the next that sees a surface; 64 where there is none.
var<workgroup> next_surface: array<u32, 64>;

fn given_about(point: Point, light: LightSample, least: f32) -> f32 {
    let cosine = dot(normalize(light.toward), point.normal);
    let mean = (light.radiance.x + light.radiance.y + light.radiance.z) / 3.0;
    let upright = light.geometry / select(cosine, 1e-4, abs(cosine) < 1e-4);
    return mean * max(upright, 0.0) * max(cosine, least) / light.density;
}

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let block = group.x;
    let own = points[block * 64u + invocation];
    let other = points[block * 64u + (invocation ^ 1u)];
    let far = points[block * 64u + (invocation + 32u) % 64u];
    let alike = dot(own.normal, other.normal) > ONE_ORIENTATION
        && dot(own.normal, far.normal) > ONE_ORIENTATION;
    if !alike { atomicStore(&uneven, 1u); }
    if invocation == 0u {
        var next = 64u;
        for (var i = 128u; i > 0u; i--) {
            let place = (i - 1u) % 64u;
            if points[block * 64u + place].surface != NOTHING { next = place; }
            next_surface[place] = next;
        }
    }
    workgroupBarrier();
    let least = select(LEAST_COSINE.x, LEAST_COSINE.y, atomicLoad(&uneven) != 0u);
    for (var stratum = invocation; stratum < params.strata; stratum += 64u) {
        // Of a run of more lights than are asked, not the same in all blocks.
        let long_run = light_stratum(stratum).extent.x > f32(ASKED);
        let first = select(0.5, f32(hash(params.first_block + block) >> 8u) / 16777216.0, long_run);
        var sum = 0.0;
        for (var i = 0u; i < ASKED; i++) {
            // One in each quarter of the block, the same for all strata: their shares have no noise.
            let place = next_surface[16u * i + (7u * i + 3u) % 16u];
            let point = points[block * 64u + min(place, 63u)];
            let u = fract(vec2f(first, 0.5) + f32(i) * vec2f(0.7548777, 0.5698403));
            let light = sample_stratum(stratum, point, u, params.offset);
            sum += select(given_about(point, light, least), 0.0, place == 64u);
        }
        unshadowed[block * params.strata + stratum] = sum;
    }
}
