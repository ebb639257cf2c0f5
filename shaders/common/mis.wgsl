// Multiple importance sampling of light from areas: places drawn on the lights, and directions
// drawn for the next segment, each weighted by the power heuristic. Veach and Guibas, 1995.

// The weight of a place drawn with the first density where the other way has the second.
fn mis_weight(own: f32, other: f32) -> f32 {
    let share = other / own;
    return 1.0 / (1.0 + share * share);
}
