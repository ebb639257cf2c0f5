// The pixels of a workgroup that want more rays, one after the other, so that no lanes idle beside
// them.

var<workgroup> listed_bits: array<atomic<u32>, 2>;
var<workgroup> listed_points: array<u32, 64>;

struct Listed {
    // The place of an invocation's own point in the list, and how long the list is.
    rank: u32,
    count: u32,
}

// All invocations must call it together, and once.
fn list_points(is: bool, own: u32, invocation: u32) -> Listed {
    if is { atomicOr(&listed_bits[invocation / 32u], 1u << (invocation % 32u)); }
    workgroupBarrier();
    let bits = vec2u(atomicLoad(&listed_bits[0]), atomicLoad(&listed_bits[1]));
    let before = (1u << (invocation % 32u)) - 1u;
    let rank = select(
        countOneBits(bits.x & before),
        countOneBits(bits.x) + countOneBits(bits.y & before),
        invocation >= 32u,
    );
    if is { listed_points[rank] = own; }
    workgroupBarrier();
    return Listed(rank, countOneBits(bits.x) + countOneBits(bits.y));
}
