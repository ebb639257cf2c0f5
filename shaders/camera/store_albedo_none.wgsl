// The albedo of points is that of their materials: there is nothing to keep.

fn keep_albedo(index: u32, hit: Hit, point: Point) {}
