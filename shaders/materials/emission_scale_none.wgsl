// The emission of points is that of their materials.

// What the emission of the point of an index is multiplied by.
fn emission_scale_of(index: u32) -> vec3f {
    return vec3f(1.0);
}
