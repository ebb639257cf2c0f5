// The cone of directions that a sphere fills, as a point sees it.

struct Cone {
    // 1 - cosine of half its angle; 2 is all directions.
    width: f32,
    inside: bool,
}

fn cone_of_sphere(point: Point, center: vec3f, radius: f32) -> Cone {
    let between = center - point.position;
    let square = dot(between, between) / (radius * radius);
    // A point on the sphere itself sees of it what is on its side.
    let on_it = abs(square - 1.0) < 1e-4;
    let nearer = square < 1.0;
    let faces = dot(between, point.normal) > 0.0;
    let inside = select(nearer, faces, on_it);
    let squared_sine = min(1.0 / max(square, 1e-12), 1.0);
    // No difference of near numbers, however far away the sphere is.
    let width = squared_sine / (1.0 + sqrt(1.0 - squared_sine));
    return Cone(select(width, 2.0, inside), inside);
}
