// A beam: a few rays through one pixel, which are traced together.

const BEAM_RAYS = 4u;

struct Beam {
    d0: vec3f,
    d1: vec3f,
    d2: vec3f,
    d3: vec3f,
    // The limit 0 means no ray.
    limits: vec4f,
}

struct BeamHits {
    h0: Hit,
    h1: Hit,
    h2: Hit,
    h3: Hit,
}

fn beam_direction(beam: Beam, i: u32) -> vec3f {
    return select(select(beam.d0, beam.d1, i == 1u), select(beam.d2, beam.d3, i == 3u), i >= 2u);
}

fn beam_hit(hits: BeamHits, i: u32) -> Hit {
    let h = hits;
    let t = select(select(h.h0.t, h.h1.t, i == 1u), select(h.h2.t, h.h3.t, i == 3u), i >= 2u);
    let triangle = select(
        select(h.h0.triangle, h.h1.triangle, i == 1u),
        select(h.h2.triangle, h.h3.triangle, i == 3u),
        i >= 2u,
    );
    let weights = select(
        select(h.h0.weights, h.h1.weights, i == 1u),
        select(h.h2.weights, h.h3.weights, i == 3u),
        i >= 2u,
    );
    return Hit(t, triangle, weights);
}

// The rays of a pixel from one on, those of them that come before `end`.
fn pixel_beam(pixel: vec2u, stream: u32, ray: u32, end: u32) -> Beam {
    let rays = vec4u(ray, ray + 1u, ray + 2u, ray + 3u);
    return Beam(
        ray_direction(pixel, stream, rays.x),
        ray_direction(pixel, stream, rays.y),
        ray_direction(pixel, stream, rays.z),
        ray_direction(pixel, stream, rays.w),
        select(vec4f(0.0), vec4f(HUGE), rays < vec4u(end)),
    );
}
