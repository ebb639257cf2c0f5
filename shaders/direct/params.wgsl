// Parameters and buffers of the stages of direct light.

struct DirectParams {
    points: u32,
    lights: u32,
    first: u32,
    count: u32,
    seed: u32,
    first_block: u32,
    offset: f32,
    nodes: u32,
    sample: u32,
    samples: u32,
    // Of a point, over all dispatches.
    rays: u32,
    // Places that each ray chooses from.
    candidates: u32,
    // Parts of the rays that are stratified by themselves.
    halves: u32,
    // Of places on area lights, spheres and the environment, the density with which light samples are
    // taken to be drawn: by area over the mean radiance; the probability of a sphere over its mean
    // radiance, sides and squared radius; by solid angle over the mean radiance. 0 where none are.
    area_density: f32,
    solid_density: f32,
    sky_density: f32,
    // Of the points that take most.
    most_rays: u32,
    // Lobes take rays whose exponent is at least the one and below the other.
    least_shininess: f32,
    most_shininess: f32,
    pad: u32,
}

@group(0) @binding(0) var<storage, read> params: DirectParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(7) var<storage, read_write> irradiance: array<Gathered>;
