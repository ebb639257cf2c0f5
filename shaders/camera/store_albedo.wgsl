// Stores the albedo where a ray has hit, for `albedo_of`: over a cone around it of a width there,
// as `textured` takes it.

@group(0) @binding(3) var<storage, read> materials: array<Material>;

fn store_albedo(index: u32, hit: Hit, point: Point, direction: vec3f, width: f32) {
    if point.surface == NOTHING { return; }
    let material = point.surface & ~FRONT;
    let texture = textured(material_textures[material].x, hit, point, direction, width);
    albedos[index] = vec4f(materials[material].albedo * texture * vertex_color(hit), 0.0);
}
