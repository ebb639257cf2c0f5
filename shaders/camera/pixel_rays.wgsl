// The rays of a pixel beside the one that finds its visible point. The first of them are traced
// everywhere, more where surfaces of unlike radiance meet.

const MOST_FIRST = 4u;

// First rays of a sample: four over all samples, or one each.
fn first_rays() -> u32 {
    return min((MOST_FIRST + params.samples - 1u) / params.samples, params.edge_rays);
}

// A ray's number in the sequence of its pixel: the first rays of all samples come first.
fn ray_number(ray: u32) -> u32 {
    let first = first_rays();
    let more = params.samples * first + params.sample * (params.edge_rays - first) + ray - first;
    return select(more, params.sample * first + ray, ray < first);
}

// The seed of a pixel's sequence.
fn ray_stream(pixel: vec2u) -> u32 {
    return hash(camera_stream(pixel));
}

fn ray_direction(pixel: vec2u, stream: u32, ray: u32) -> vec3f {
    return camera_direction(pixel, scrambled(ray_number(ray), stream));
}

// The width of the cone of rays that one stands for, at distance 1.
fn ray_spread(direction: vec3f) -> f32 {
    return pixel_spread(direction) * inverseSqrt(f32(first_rays()));
}
