// The bound on the geometry term: what is kept, and what is removed.

fn kept(g: f32, bound: f32) -> f32 {
    return min(g, bound);
}

fn removed(g: f32, bound: f32) -> f32 {
    return max(g - bound, 0.0);
}
