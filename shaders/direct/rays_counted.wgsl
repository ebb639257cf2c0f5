// Points take as many light samples as were counted for them.

@group(0) @binding(88) var<storage, read> ray_counts: array<u32>;

fn rays_of(point: u32) -> u32 {
    return ray_counts[point];
}
