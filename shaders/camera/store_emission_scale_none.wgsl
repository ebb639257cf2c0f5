// The emission of points is that of their materials: there is nothing to keep.

fn keep_glow(index: u32, hit: Hit, point: Point) {}
