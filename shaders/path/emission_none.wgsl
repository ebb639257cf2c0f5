// Nothing emits that a segment could happen upon.

fn find_emission(
    slot: u32,
    carried: vec3f,
    start: Point,
    met: Hit,
    hit: Point,
    direction: vec3f,
    density: f32,
) {}
