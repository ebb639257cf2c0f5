// A light, or a place on one, as a point sees it if nothing is between.

struct LightSample {
    // The way of a shadow ray from where it starts, of any length; hits count at 0 < t < limit.
    toward: vec3f,
    limit: f32,
    // Whether light and point face each other.
    faces: bool,
    // What times the geometry term is irradiance: radiance, or of lights without extent intensity.
    radiance: vec3f,
    // The geometry term, in the measure that the density is of.
    geometry: f32,
    // With which it was drawn.
    density: f32,
}
