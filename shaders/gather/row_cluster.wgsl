// A point reads the row of the bit matrix that its cluster's representative has traced.

@group(0) @binding(12) var<storage, read> cluster_of: array<u32>;

fn row_of(point: u32) -> Rows {
    return cluster_of[point];
}
