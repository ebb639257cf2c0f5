// The emission of points is that of their materials: there is nothing to store.

fn store_emission_scale(index: u32, hit: Hit, point: Point, direction: vec3f, width: f32) {}
