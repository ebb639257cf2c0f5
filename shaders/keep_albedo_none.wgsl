// No texture varies an albedo: it is that of the material.

fn keep_albedo(index: u32, hit: Hit, point: Point) {}
