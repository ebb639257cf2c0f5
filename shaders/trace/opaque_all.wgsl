// No surface has holes.

fn opaque(kind: u32, index: u32, weights: vec3f) -> bool {
    return true;
}
