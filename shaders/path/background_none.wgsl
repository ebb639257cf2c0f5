// There is nothing where a segment hits nothing.

fn find_background(slot: u32, carried: vec3f, direction: vec3f, density: f32) {}
