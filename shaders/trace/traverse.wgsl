// Closest and any hit of a ray by itself. The twin of src/bvh/traverse.rs.

struct Node {
    low: vec3f,
    skip: u32,
    high: vec3f,
    leaf: u32,
}

@group(0) @binding(1) var<storage, read> nodes: array<Node>;
@group(0) @binding(2) var<storage, read> triangles: array<Triangle>;

fn load_triangle(i: u32) -> Triangle {
    return triangles[i];
}

// Whether some ray that is traced together with this one wants it.
fn some_ray(is: bool) -> bool {
    return is;
}

// The nearest hit at 0 < t < limit, or, with `any`, the first one met. The limit 0 means no
// ray.
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
        // What is as near may be in a box that by rounding begins behind it.
        let far = best.t * BEYOND;
        if !meets_box(reciprocal, node.low - origin, node.high - origin, far) {
            at = node.skip;
            continue;
        }
        let end = node.leaf / 8u + node.leaf % 8u;
        for (var i = node.leaf / 8u; i < end; i++) {
            let corners = triangles[i];
            let m = meet(corners.a, corners.b, corners.c, corners.kind, origin, direction);
            // At t = limit nothing counts, as `lowest` is set only by a hit.
            let tie = m.t == best.t && lowest != NOTHING && corners.index < lowest;
            let counts = m.inside && m.t > 0.0 && (m.t < best.t || tie);
            if counts && opaque(corners.kind, corners.index, m.weights) {
                best = Hit(m.t, i, m.weights);
                lowest = corners.index;
                if any { return best; }
            }
        }
        at += 1u;
    }
    return best;
}
