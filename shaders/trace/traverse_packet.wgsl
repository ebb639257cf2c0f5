// Closest and any hit for a subgroup that goes through the hierarchy as one: as
// traverse.wgsl, for rays that are near each other. All lanes must call it together. Nodes of four
// children (src/bvh/wide.rs) and triangles are loaded by eight lanes together, four words each.

@group(0) @binding(90) var node_table: texture_2d<u32>;
@group(0) @binding(91) var triangle_table: texture_2d<u32>;

// The second node: see src/bvh/wide.rs.
const ROOT = 8u;
// Of children that no ray meets.
const LAST_KEY = 0x7ffffffc;

fn load_triangle(i: u32) -> Triangle {
    let one = textureLoad(triangle_table, table_place(3u * i), 0);
    let two = textureLoad(triangle_table, table_place(3u * i + 1u), 0);
    let three = textureLoad(triangle_table, table_place(3u * i + 2u), 0);
    return Triangle(
        bitcast<vec3f>(one.xyz),
        one.w,
        bitcast<vec3f>(two.xyz),
        two.w,
        bitcast<vec3f>(three.xyz),
        three.w,
    );
}

// Whether some ray that is traced together with this one wants it.
fn some_ray(is: bool) -> bool {
    return subgroupAny(is);
}

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

// Whether the ray meets a child, which these words hold, at 0 <= t <= reach.
fn meets_child(low: vec4u, high: vec4u, reciprocal: vec3f, origin: vec3f, reach: f32) -> bool {
    let bottom = bitcast<vec3f>(low.xyz) - origin;
    let top = bitcast<vec3f>(high.xyz) - origin;
    return low.w != 0u && meets_box(reciprocal, bottom, top, reach);
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

// The nearest hit at 0 < t < limit, or, with `any`, one of them. The limit 0 means no ray.
fn traverse(
    origin: vec3f,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    any: bool,
    invocation: u32,
) -> Hit {
    let lane = invocation & 7u;
    let reciprocal = finite_reciprocal(direction);
    var best = Hit(limit, NOTHING, vec3f(0.0));
    var lowest = NOTHING;
    // A lane that has what it wants sets this below 0, and meets nothing any more.
    var reach = select(limit, -1.0, limit <= 0.0);
    // The way of the packet, along which children are in order.
    let ahead = subgroupAdd(select(vec3f(0.0), direction, limit > 0.0));
    var stack = Stack();
    var link = select(0u, ROOT, subgroupAny(limit > 0.0));
    while link != 0u {
        // Down to the next leaf that some ray meets.
        while link != 0u && (link & 7u) == 0u {
            let words = textureLoad(node_table, table_place(link + lane), 0);
            let low0 = subgroupBroadcast(words, 0u);
            let high0 = subgroupBroadcast(words, 1u);
            let low1 = subgroupBroadcast(words, 2u);
            let high1 = subgroupBroadcast(words, 3u);
            let low2 = subgroupBroadcast(words, 4u);
            let high2 = subgroupBroadcast(words, 5u);
            let low3 = subgroupBroadcast(words, 6u);
            let high3 = subgroupBroadcast(words, 7u);
            // What is as near may be in a box that by rounding begins behind it.
            let far = reach * BEYOND;
            let met = subgroupOr(
                select(0u, 1u, meets_child(low0, high0, reciprocal, origin, far))
                | select(0u, 2u, meets_child(low1, high1, reciprocal, origin, far))
                | select(0u, 4u, meets_child(low2, high2, reciprocal, origin, far))
                | select(0u, 8u, meets_child(low3, high3, reciprocal, origin, far))
            );
            link = next_child(&stack, words, met, ahead, lane);
        }
        let end = link / 8u + link % 8u;
        for (var i = link / 8u; i < end; i++) {
            let loaded = textureLoad(triangle_table, table_place(3u * i + min(lane, 2u)), 0);
            let one = subgroupBroadcast(loaded, 0u);
            let two = subgroupBroadcast(loaded, 1u);
            let three = subgroupBroadcast(loaded, 2u);
            let index = two.w;
            let kind = three.w;
            let m = meet(
                bitcast<vec3f>(one.xyz), bitcast<vec3f>(two.xyz), bitcast<vec3f>(three.xyz),
                kind, origin, direction,
            );
            // At t = limit nothing counts, as `lowest` is set only by a hit.
            let tie = m.t == best.t && lowest != NOTHING && index < lowest;
            let counts = m.inside && m.t > 0.0 && reach > 0.0 && (m.t < best.t || tie);
            if counts && opaque(kind, index, m.weights) {
                best = Hit(m.t, i, m.weights);
                lowest = index;
                reach = select(m.t, -1.0, any);
            }
        }
        link = next_link(&stack, 0u, 0u, lane);
        if any && !subgroupAny(reach > 0.0) { break; }
    }
    return best;
}
