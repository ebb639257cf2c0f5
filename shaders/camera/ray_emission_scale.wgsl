// A texture may vary what a material emits.

fn ray_emission_scale(material: u32, hit: Hit, seen: Point, direction: vec3f, width: f32) -> vec3f {
    return textured(material_textures[material].y, hit, seen, direction, width);
}
