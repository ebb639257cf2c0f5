// What those stages find: a bit for each row and light, 32 lights a word, word by word.

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
