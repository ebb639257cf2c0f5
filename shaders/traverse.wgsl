// Closest and any hit. The twin of src/bvh/traverse.rs, line by line.

struct Node {
    low: vec3f,
    skip: u32,
    high: vec3f,
    leaf: u32,
}

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

@group(0) @binding(1) var<storage, read> nodes: array<Node>;
@group(0) @binding(2) var<storage, read> triangles: array<Triangle>;

// Finite stand-in for the reciprocal of a direction's zero component.
const HUGE = 1e30;
// 1 + 2 gamma(3): Ize, "Robust BVH Ray Traversal", JCGT 2013.
const WIDEN = 1.0000004;

fn finite_reciprocal(x: vec3f) -> vec3f {
    let huge = select(vec3f(HUGE), vec3f(-HUGE), x < vec3f(0.0));
    return select(huge, 1.0 / x, abs(x) > vec3f(1.0 / HUGE));
}

fn load_triangle(i: u32) -> Triangle {
    return triangles[i];
}

// The nearest hit at 0 < t < limit, or, with `any`, the first one met. No ray is traced where
// the limit is 0.
fn traverse(
    origin: vec3f,
    direction: vec3f,
    limit: f32,
    node_count: u32,
    any: bool,
    invocation: u32,
) -> Hit {
    let reciprocal = finite_reciprocal(direction);
    var best = Hit(limit, NOTHING, vec3f(0.0));
    var lowest = NOTHING;
    var at = select(0u, node_count, limit <= 0.0);
    while at < node_count {
        let node = nodes[at];
        let t0 = (node.low - origin) * reciprocal;
        let t1 = (node.high - origin) * reciprocal;
        let first = min(t0, t1);
        let last = max(t0, t1);
        let near = max(max(first.x, first.y), max(first.z, 0.0));
        let far = min(last.x, min(last.y, last.z)) * WIDEN;
        if near > min(far, best.t) {
            at = node.skip;
            continue;
        }
        let end = node.leaf / 8u + node.leaf % 8u;
        for (var i = node.leaf / 8u; i < end; i++) {
            let corners = triangles[i];
            // Volumes that the ray spans with the edges: Pluecker form of the watertight
            // test of Woop, Benthin and Wald, JCGT 2013.
            let a = corners.a - origin;
            let b = corners.b - origin;
            let c = corners.c - origin;
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
            if (least < 0.0 && most > 0.0) || speed == 0.0 || sum == 0.0 { continue; }
            let t = dot(normal, a) / speed;
            if t > 0.0 && (t < best.t || (t == best.t && corners.index < lowest)) {
                // At t = limit nothing counts, as `lowest` is set only by a hit.
                if t == best.t && lowest == NOTHING { continue; }
                best = Hit(t, i, volumes / sum);
                lowest = corners.index;
                if any { return best; }
            }
        }
        at += 1u;
    }
    return best;
}
