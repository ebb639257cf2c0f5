// Nodes of four children (src/bvh/wide.rs), through which a subgroup goes as one: eight lanes load a
// node, or a triangle, together, four words each, and have a stack of links together.

@group(0) @binding(90) var node_table: texture_2d<u32>;
@group(0) @binding(91) var triangle_table: texture_2d<u32>;

// The second node: see src/bvh/wide.rs.
const ROOT = 8u;
// Of children that no ray meets.
const LAST_KEY = 0x7ffffffc;

// Links to what is still to be visited, the next first: eight a register, one a lane.
struct Stack {
    a: u32,
    b: u32,
    c: u32,
    d: u32,
    e: u32,
    f: u32,
    g: u32,
    h: u32,
}

// Puts links before those of a stack, of which lane i has the i-th; takes the first off. 0 if there
// are none.
fn next_link(stack: ptr<function, Stack>, links: u32, count: u32, lane: u32) -> u32 {
    let before = *stack;
    let pops = count == 0u;
    let next = select(subgroupBroadcast(links, 0u), subgroupBroadcast(before.a, 0u), pops);
    // What is in a register moves on by so many lanes less one; what leaves it enters the next.
    let source = (lane + 1u - count) & 7u;
    let enters = select(lane + 1u < count, lane == 7u, pops);
    let a = subgroupShuffle(before.a, source);
    let b = subgroupShuffle(before.b, source);
    let c = subgroupShuffle(before.c, source);
    let d = subgroupShuffle(before.d, source);
    let e = subgroupShuffle(before.e, source);
    let f = subgroupShuffle(before.f, source);
    let g = subgroupShuffle(before.g, source);
    let h = subgroupShuffle(before.h, source);
    let rest = subgroupShuffle(links, (lane + 1u) & 7u);
    *stack = Stack(
        select(a, select(rest, b, pops), enters),
        select(b, select(a, c, pops), enters),
        select(c, select(b, d, pops), enters),
        select(d, select(c, e, pops), enters),
        select(e, select(d, f, pops), enters),
        select(f, select(e, g, pops), enters),
        select(g, select(f, h, pops), enters),
        select(h, select(g, 0u, pops), enters),
    );
    return next;
}

// Numbers that are in order as these are, NaN or not, with a child's index to tell them apart.
fn order_key(along: f32, child: u32) -> i32 {
    let bits = bitcast<i32>(along);
    return ((bits ^ ((bits >> 31u) & 0x7fffffff)) & ~3) | i32(child);
}

// Goes on with the children of a node, which these words hold, that some ray meets: a bit each. They
// are visited in the order of their middles along `ahead`.
fn next_child(
    stack: ptr<function, Stack>,
    words: vec4u,
    met: u32,
    ahead: vec3f,
    lane: u32,
) -> u32 {
    let child = lane >> 1u;
    let end = dot(bitcast<vec3f>(words.xyz), ahead);
    let along = order_key(end + subgroupShuffle(end, lane ^ 1u), child);
    let key = select(LAST_KEY | i32(child), along, ((met >> child) & 1u) != 0u);
    let rank = u32(subgroupBroadcast(key, 0u) < key)
        + u32(subgroupBroadcast(key, 2u) < key)
        + u32(subgroupBroadcast(key, 4u) < key)
        + u32(subgroupBroadcast(key, 6u) < key);
    // The lane of the child that comes as the lane's number.
    var place = 6u;
    place = select(place, 4u, subgroupBroadcast(rank, 4u) == lane);
    place = select(place, 2u, subgroupBroadcast(rank, 2u) == lane);
    place = select(place, 0u, subgroupBroadcast(rank, 0u) == lane);
    let links = subgroupShuffle(words.w, place);
    return next_link(stack, links, countOneBits(met), lane);
}
