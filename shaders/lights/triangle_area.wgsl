// Samples an emitting triangle by area: uniform on it, as paths may find it by chance with a
// density that is known by area.

fn sample_triangle(point: Point, light: AreaLight, u: vec2f) -> TriangleSample {
    return uniform_on_triangle(light, u);
}
