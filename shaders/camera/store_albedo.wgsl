// Stores the albedo where a ray has hit, for `albedo_of`.

@group(0) @binding(3) var<storage, read> materials: array<Material>;

fn store_albedo(index: u32, hit: Hit, point: Point) {
    if point.surface == NOTHING { return; }
    let material = point.surface & ~FRONT;
    let texture = textured(material_textures[material].x, hit);
    albedos[index] = vec4f(materials[material].albedo * texture, 0.0);
}
