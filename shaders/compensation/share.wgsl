// The share of the light along a segment that the bound on the geometry term takes from virtual
// point lights, and that paths give back: max(0, G - b) / G. Kollig and Keller, "Illumination in
// the Presence of Weak Singularities", 2004, equation 6.

// Of a geometry term over the bound.
fn clamped_share(relative: f32) -> f32 {
    return select(0.0, 1.0 - 1.0 / relative, relative > 1.0);
}
