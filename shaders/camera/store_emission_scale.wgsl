// Keeps what varies the emission where a ray has hit, for `glow_of`.

fn keep_glow(index: u32, hit: Hit, point: Point) {
    if point.surface == NOTHING { return; }
    let material = point.surface & ~FRONT;
    glows[index] = vec4f(textured(material_textures[material].y, hit), 0.0);
}
