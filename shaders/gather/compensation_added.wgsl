// With bias compensation: what it adds to the light that a visible point has gathered.

@group(0) @binding(29) var<storage, read> compensated: array<Gathered>;

fn with_compensation(point: u32, light: Gathered) -> Gathered {
    return light + compensated[point];
}

// Over the image: what pixels have combined is about as much as they had.
fn without_compensation(point: u32, light: Gathered) -> Gathered {
    return light + compensated[point] * -1.0;
}
