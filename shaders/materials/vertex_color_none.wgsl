// Corners without colours.

fn vertex_color(hit: Hit) -> vec3f {
    return vec3f(1.0);
}
