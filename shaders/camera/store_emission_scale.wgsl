// Stores what a texture multiplies the emission by where a ray has hit, for `emission_scale_of`.

fn store_emission_scale(index: u32, hit: Hit, point: Point) {
    if point.surface == NOTHING { return; }
    let material = point.surface & ~FRONT;
    emission_scales[index] = vec4f(textured(material_textures[material].y, hit), 0.0);
}
