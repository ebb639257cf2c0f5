// Parameters of the stages of interleaved sampling, and what a subset is. The pixels of a tile fall
// into s x s subsets, by their place modulo s; all pixels of a subset gather the same VPLs. Points
// in the order of subsets are, subset after subset, the images of those pixels alone.

struct InterleaveParams {
    // Of the tile, in pixels.
    width: u32,
    height: u32,
    s: u32,
    // By how many subsets this sample is ahead of the first.
    rotation: u32,
    // Pixels across a subset, and its points.
    subset_width: u32,
    subset_points: u32,
    // Points in the order of subsets.
    points: u32,
    // Of the two that combine.
    axis: u32,
}

@group(0) @binding(0) var<storage, read> params: InterleaveParams;
