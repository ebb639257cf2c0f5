// The density with which cells of an environment's image are drawn: a row by its light, then a
// cell of it. Pharr, Jakob and Humphreys, "Physically Based Rendering", 12.5.

const ENVIRONMENT_ROWS = 8u;

fn environment_before(at: u32) -> f32 {
    return bitcast<f32>(environment_word(at));
}

// Columns and rows of cells.
fn environment_cell_count() -> vec2u {
    return textureLoad(environment, table_place(1u), 0).yz;
}

// Where the intervals of the cells of a row begin.
fn environment_cells(row: u32) -> u32 {
    let count = environment_cell_count();
    return ENVIRONMENT_ROWS + count.y + 1u + row * (count.x + 1u);
}

fn environment_cell(place: vec2f) -> vec2u {
    let count = environment_cell_count();
    return min(vec2u(place * vec2f(count)), count - 1u);
}

// By solid angle, of a place of the image that is drawn uniformly in a cell; `sine` is that of the
// angle between the place's direction and the poles.
fn environment_density(cell: vec2u, sine: f32) -> f32 {
    let count = environment_cell_count();
    let cells = f32(count.x * count.y);
    let row = ENVIRONMENT_ROWS + cell.y;
    let column = environment_cells(cell.y) + cell.x;
    let probability = (environment_before(row + 1u) - environment_before(row))
        * (environment_before(column + 1u) - environment_before(column));
    // Nearer to a pole there is next to nothing.
    return probability * cells / (2.0 * PI * PI * max(sine, 1e-6));
}
