// What the textures of materials multiply albedo and emission by, at a place. For paths that have
// bounced: their directions are drawn anew each time, so that many of them average what a filter
// would.

// Textures of each material, plus one: of the albedo, of the emission. 0 for none.
@group(0) @binding(43) var<storage, read> material_textures: array<vec2u>;

// Of such a texture where a ray has hit.
fn textured(used: u32, hit: Hit, point: Point, direction: vec3f, width: f32) -> vec3f {
    if used == 0u { return vec3f(1.0); }
    let shape = load_triangle(hit.triangle);
    return sample_texture(used - 1u, texture_coordinates(shape.kind, shape.index, hit.weights)).rgb;
}
