// Parameters and buffers of visibility, the stage that finds which rows (points) see which VPLs: a
// bit each, 32 VPLs a word, word by word.

struct VisibilityParams {
    rows: u32,
    vpls: u32,
    first_word: u32,
    matrix_word: u32,
    offset: f32,
    nodes: u32,
    first: u32,
    count: u32,
    first_point: u32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

@group(0) @binding(0) var<storage, read> params: VisibilityParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(5) var<storage, read> vpls: array<Vpl>;
@group(0) @binding(6) var<storage, read_write> bits: array<u32>;
// Rays traced, in two words; then invocations whose loops did not come to their end, as some
// drivers bound the rounds of all loops of an invocation, and leave them silently.
@group(0) @binding(10) var<storage, read_write> counter: array<atomic<u32>, 3>;

fn count_rays(rays: u32, finished: bool) {
    if !finished { atomicAdd(&counter[2], 1u); }
    let before = atomicAdd(&counter[0], rays);
    if before + rays < before { atomicAdd(&counter[1], 1u); }
}

// What dispatches with earlier VPLs of the same word have found.
fn earlier(at: u32) -> u32 {
    return select(bits[at], 0u, params.first == 0u);
}
