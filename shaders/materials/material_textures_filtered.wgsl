// What the textures of materials multiply albedo and emission by, over the part of a surface that a
// pixel sees.

// Textures of each material, plus one: of the albedo, of the emission. 0 for none.
@group(0) @binding(43) var<storage, read> material_textures: array<vec2u>;

// Of such a texture where a ray has hit, over a cone around it of this width there.
fn textured(used: u32, hit: Hit, point: Point, direction: vec3f, width: f32) -> vec3f {
    if used == 0u { return vec3f(1.0); }
    let shape = load_triangle(hit.triangle);
    let uv = texture_coordinates(shape.kind, shape.index, hit.weights);
    let seen = footprint_of(point, direction, width);
    let along = uv_difference(shape, hit.weights, seen.along);
    let across = uv_difference(shape, hit.weights, seen.across);
    return sample_texture_over(used - 1u, uv, along, across);
}
