// No bound on the geometry term.

fn kept(g: f32, bound: f32) -> f32 {
    return g;
}

fn removed(g: f32, bound: f32) -> f32 {
    return 0.0;
}
