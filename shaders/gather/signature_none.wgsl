// No probes: all points of a surface are alike.

fn signature_of(point: u32) -> u32 {
    return 0u;
}
