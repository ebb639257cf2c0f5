// Every point has its own row of the bit matrix.

fn row_of(point: u32) -> Rows {
    return point - params.first_point;
}
