// Keeps the albedo where a ray has hit, for `albedo_of`.

@group(0) @binding(3) var<storage, read> materials: array<Material>;
// Textures of each material, plus one: of the albedo, of the emission. 0 for none.
@group(0) @binding(43) var<storage, read> material_textures: array<vec2u>;

fn keep_albedo(index: u32, hit: Hit, point: Point) {
    if point.surface == NOTHING { return; }
    let material = point.surface & ~FRONT;
    let plain = materials[material].albedo;
    let used = material_textures[material].x;
    var albedo = plain;
    if used != 0u {
        let shape = load_triangle(hit.triangle);
        let uv = texture_coordinates(shape.kind, shape.index, hit.weights);
        albedo = plain * sample_texture(used - 1u, uv).rgb;
    }
    albedos[index] = vec4f(albedo, 0.0);
}
