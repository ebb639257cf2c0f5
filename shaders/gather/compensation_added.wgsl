// What bias compensation gives back to a visible point, beside what it has gathered.

@group(0) @binding(29) var<storage, read> compensated: array<Gathered>;

fn with_given_back(point: u32, light: Gathered) -> Gathered {
    return light + compensated[point];
}

// Over the image: what pixels have combined is about as much as they had.
fn without_given_back(point: u32, light: Gathered) -> Gathered {
    return light + compensated[point] * -1.0;
}
