// No bound on the geometry term.

fn bounded_geometry(g: f32, bound: f32) -> f32 {
    return g;
}

fn clamped_geometry(g: f32, bound: f32) -> f32 {
    return 0.0;
}
