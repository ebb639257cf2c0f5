// Closest and any hit for a subgroup that goes through the hierarchy as one: as
// traverse.wgsl, for rays that are near each other. Nodes and triangles are loaded by eight
// lanes together, a word each. All lanes must call it together; the limit 0 means no ray.

struct Triangle {
    a: vec3f,
    material: u32,
    b: vec3f,
    index: u32,
    c: vec3f,
    pad: u32,
}

struct Hit {
    t: f32,
    // In leaf order; NOTHING if there is no hit.
    triangle: u32,
    // Barycentric weights of the corners.
    weights: vec3f,
}

@group(0) @binding(1) var<storage, read> nodes: array<f32>;
@group(0) @binding(2) var<storage, read> triangles: array<f32>;

// Finite stand-in for the reciprocal of a direction's zero component.
const HUGE = 1e30;
// 1 + 2 gamma(3): Ize, "Robust BVH Ray Traversal", JCGT 2013.
const WIDEN = 1.0000004;

fn finite_reciprocal(x: vec3f) -> vec3f {
    let huge = select(vec3f(HUGE), vec3f(-HUGE), x < vec3f(0.0));
    return select(huge, 1.0 / x, abs(x) > vec3f(1.0 / HUGE));
}

fn load_vector(at: u32) -> vec3f {
    return vec3f(triangles[at], triangles[at + 1u], triangles[at + 2u]);
}

fn load_triangle(i: u32) -> Triangle {
    let at = 12u * i;
    return Triangle(
        load_vector(at),
        bitcast<u32>(triangles[at + 3u]),
        load_vector(at + 4u),
        bitcast<u32>(triangles[at + 7u]),
        load_vector(at + 8u),
        0u,
    );
}

// The nearest hit at 0 < t < limit, or, with `any`, one of them.
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
    var at = 0u;
    while at < node_count {
        // Down to the next leaf that some ray meets.
        var leaf = 0u;
        while at < node_count {
            let loaded = nodes[8u * at + lane];
            let low = vec3f(
                subgroupBroadcast(loaded, 0u),
                subgroupBroadcast(loaded, 1u),
                subgroupBroadcast(loaded, 2u),
            );
            let high = vec3f(
                subgroupBroadcast(loaded, 4u),
                subgroupBroadcast(loaded, 5u),
                subgroupBroadcast(loaded, 6u),
            );
            let t0 = (low - origin) * reciprocal;
            let t1 = (high - origin) * reciprocal;
            let first = min(t0, t1);
            let last = max(t0, t1);
            let near = max(max(first.x, first.y), max(first.z, 0.0));
            let far = min(last.x, min(last.y, last.z)) * WIDEN;
            let met = subgroupAny(near <= min(far, reach));
            leaf = select(0u, bitcast<u32>(subgroupBroadcast(loaded, 7u)), met);
            at = select(bitcast<u32>(subgroupBroadcast(loaded, 3u)), at + 1u, met);
            if leaf != 0u { break; }
        }
        let end = leaf / 8u + leaf % 8u;
        for (var i = leaf / 8u; i < end; i++) {
            let head = triangles[12u * i + lane];
            let tail = triangles[12u * i + 8u + (lane & 3u)];
            let index = bitcast<u32>(subgroupBroadcast(head, 7u));
            // The test of traverse.wgsl.
            let a = vec3f(
                subgroupBroadcast(head, 0u),
                subgroupBroadcast(head, 1u),
                subgroupBroadcast(head, 2u),
            ) - origin;
            let b = vec3f(
                subgroupBroadcast(head, 4u),
                subgroupBroadcast(head, 5u),
                subgroupBroadcast(head, 6u),
            ) - origin;
            let c = vec3f(
                subgroupBroadcast(tail, 0u),
                subgroupBroadcast(tail, 1u),
                subgroupBroadcast(tail, 2u),
            ) - origin;
            let volumes = vec3f(
                dot(cross(c - b, c + b), direction),
                dot(cross(a - c, a + c), direction),
                dot(cross(b - a, b + a), direction),
            );
            let least = min(volumes.x, min(volumes.y, volumes.z));
            let most = max(volumes.x, max(volumes.y, volumes.z));
            let normal = cross(b - a, c - a);
            let speed = dot(normal, direction);
            let sum = volumes.x + volumes.y + volumes.z;
            let t = dot(normal, a) / speed;
            let inside = (least >= 0.0 || most <= 0.0) && speed != 0.0 && sum != 0.0;
            // At t = limit nothing counts, as `lowest` is set only by a hit.
            let tie = t == best.t && lowest != NOTHING && index < lowest;
            if inside && t > 0.0 && reach > 0.0 && (t < best.t || tie) {
                best = Hit(t, i, volumes / sum);
                lowest = index;
                reach = select(t, -1.0, any);
            }
        }
        if any && !subgroupAny(reach > 0.0) { break; }
    }
    return best;
}
