// With bias compensation: what it adds to the light that a visible point has gathered, before that is
// combined over pixels. Bounded light falls off into corners as what is given back rises there, so that
// combining one alone would leave them too bright or too dark.

@group(0) @binding(29) var<storage, read> compensated: array<Gathered>;

fn with_compensation(point: u32, light: Gathered) -> Gathered {
    return with_clamped(light + compensated[point], light);
}

// Over the image: what pixels have combined is about as much as they had.
fn without_compensation(point: u32, light: Gathered) -> Gathered {
    return with_clamped(light + compensated[point] * -1.0, light);
}
