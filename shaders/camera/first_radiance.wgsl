// The radiance that the first rays of a pixel see.

@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;
@group(0) @binding(103) var<storage, read> ray_codes: array<u32>;

struct FirstRadiance {
    sum: vec3f,
    // Of one ray, the least and the most.
    low: vec3f,
    high: vec3f,
}

fn first_radiance(tile: TilePixels, pixel: vec2u, own: u32) -> FirstRadiance {
    let rays = first_rays();
    let codes = ray_codes[own];
    let light = radiance[own].rgb;
    var throughput = vec3f(0.0);
    var low = vec3f(HUGE);
    var high = vec3f(0.0);
    for (var ray = 0u; ray < rays; ray++) {
        let is_own = code_of(codes, ray) == OWN;
        let one = ray_throughput(own, ray);
        throughput += select(vec3f(0.0), one, is_own);
        low = select(low, min(low, light * one), is_own);
        high = select(high, max(high, light * one), is_own);
    }
    var sum = light * throughput;
    let others = select(rays, 0u, codes == ALL_OWN);
    for (var ray = 0u; ray < others; ray++) {
        let code = code_of(codes, ray);
        if code != OWN {
            var seen = vec3f(0.0);
            if code != NO_LIGHT {
                seen = radiance[point_at(tile, around(tile, pixel, code))].rgb * ray_throughput(own, ray);
            }
            sum += seen;
            low = min(low, seen);
            high = max(high, seen);
        }
    }
    let emission = stored_ray_emission(own);
    return FirstRadiance(sum + emission.sum, low + emission.low, high + emission.high);
}
