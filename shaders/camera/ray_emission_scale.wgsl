// An emission that a texture may vary.

fn ray_emission_scale(hit: Hit, point: Point) -> vec3f {
    return textured(material_textures[point.surface & ~FRONT].y, hit);
}
