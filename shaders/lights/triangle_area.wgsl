// Where on an emitting triangle: uniform on it, as paths may find it by chance with a density that
// is known by area.

fn draw_place(point: Point, light: AreaLight, u: vec2f) -> Place {
    return uniform_place(light, u);
}
