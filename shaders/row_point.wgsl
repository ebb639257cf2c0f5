// Every point reads its own row of the bit matrix.

fn row_of(point: u32) -> u32 {
    return point;
}
