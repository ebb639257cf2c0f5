// A light of a point and a side, with a Phong lobe about the direction in which it mirrors the
// light that it got.

struct GlossyVpl {
    position: vec3f,
    shininess: f32,
    normal: vec3f,
    // The lobe at its peak over 1 / pi.
    peak: f32,
    intensity: vec3f,
    // Of the channels of the intensity.
    mean: f32,
    // What the intensity would be if the lobe were diffuse.
    specular: vec3f,
    specular_mean: f32,
    mirrored: vec3f,
    // On the geometry term.
    bound: f32,
}

alias Vpl = GlossyVpl;
