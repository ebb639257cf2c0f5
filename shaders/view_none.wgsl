// Diffuse surfaces look alike from everywhere.

fn with_view(point: Point, direction: vec3f) -> Point {
    return point;
}
