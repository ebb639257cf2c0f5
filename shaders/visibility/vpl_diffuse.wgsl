// A light of a point and a side: its intensity is the same in all directions but for the cosine.

struct Vpl {
    position: vec3f,
    pad0: f32,
    normal: vec3f,
    // On the geometry term.
    bound: f32,
    intensity: vec3f,
    // Of the channels of the intensity.
    mean: f32,
}
