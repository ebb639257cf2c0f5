// The parameters of BSDFs beside their diffuse part.

struct Bsdf {
    // Phong: k_s; mirror: reflectance; glass: what goes on of the light.
    specular: vec3f,
    kind: u32,
    // Phong: shininess; glass: index of refraction of the inside over that of the outside.
    parameter: f32,
    // Phong: with which probability a direction is drawn from the lobe.
    lobe_probability: f32,
    pad0: u32,
    pad1: u32,
}

const PHONG = 1u;
const MIRROR = 2u;
const GLASS = 3u;

@group(0) @binding(60) var<storage, read> bsdfs: array<Bsdf>;

fn bsdf_of(point: Point) -> Bsdf {
    return bsdfs[point.surface & ~FRONT];
}
