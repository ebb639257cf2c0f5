// Surfaces have holes where a texture's alpha is below one half.

// Triangle.kind: the texture, plus one.
const CUTOUT = 0x3fffffffu;

// Whether there is a surface at the place where a ray meets a shape.
fn opaque(kind: u32, index: u32, weights: vec3f) -> bool {
    let cutout = kind & CUTOUT;
    if cutout == 0u { return true; }
    return sample_texture(cutout - 1u, texture_coordinates(kind, index, weights)).a >= 0.5;
}
