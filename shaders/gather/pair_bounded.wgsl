// The bound on the geometry term: what is below it, and what the clamp takes.

fn bounded_geometry(g: f32, bound: f32) -> f32 {
    return min(g, bound);
}

fn clamped_geometry(g: f32, bound: f32) -> f32 {
    return max(g - bound, 0.0);
}
