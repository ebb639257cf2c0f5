// The emission of surfaces is that of their materials.

fn ray_emission_scale(material: u32, hit: Hit, seen: Point, direction: vec3f, width: f32) -> vec3f {
    return vec3f(1.0);
}
