// The pinhole camera.

struct CameraParams {
    position: vec3f,
    width: u32,
    forward: vec3f,
    height: u32,
    right: vec3f,
    first_block: u32,
    up: vec3f,
    sample: u32,
    samples: u32,
    seed: u32,
    blocks: u32,
    nodes: u32,
    first_ray: u32,
    rays: u32,
    edge_rays: u32,
    // By which rays that go on are kept off surfaces.
    offset: f32,
}

@group(0) @binding(0) var<storage, read> params: CameraParams;

// The unit direction in which a place of a pixel is seen.
fn camera_direction(pixel: vec2u, inside: vec2f) -> vec3f {
    let size = vec2f(f32(params.width), f32(params.height));
    let at = (vec2f(pixel) + inside) / size * 2.0 - 1.0;
    return normalize(params.forward + at.x * params.right - at.y * params.up);
}

// The width of the cone of rays around a unit direction that a sample of a pixel stands for, at
// distance 1: of all that a pixel sees, which grows with the cube of the cosine, its share.
fn pixel_spread(direction: vec3f) -> f32 {
    let cosine = dot(direction, params.forward);
    let pixels = f32(params.width) * f32(params.height);
    let area = 4.0 * length(params.right) * length(params.up) / pixels;
    return sqrt(area * cosine * cosine * cosine / f32(params.samples));
}

// The seed of the sequence of a pixel.
fn camera_stream(pixel: vec2u) -> u32 {
    return hash(hash(pixel.x + pixel.y * params.width) + params.seed);
}
