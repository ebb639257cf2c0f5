// No bias compensation: nothing is added for what the bound on the geometry term takes.

fn with_compensation(point: u32, light: Gathered) -> Gathered {
    return light;
}

fn without_compensation(point: u32, light: Gathered) -> Gathered {
    return light;
}
