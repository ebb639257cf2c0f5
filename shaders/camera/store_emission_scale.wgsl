// Stores what a texture multiplies the emission by where a ray has hit, for `emission_scale_of`,
// as `store_albedo` does.

fn store_emission_scale(index: u32, hit: Hit, point: Point, direction: vec3f, width: f32) {
    if point.surface == NOTHING { return; }
    let material = point.surface & ~FRONT;
    let scale = textured(material_textures[material].y, hit, point, direction, width);
    emission_scales[index] = vec4f(scale, 0.0);
}
