// The next segment of each path: a direction about the normal by the cosine, and what it hits.

@group(0) @binding(3) var<storage, read> materials: array<Material>;
@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(23) var<storage, read> queue: array<u32>;
@group(0) @binding(24) var<storage, read_write> survivors: array<u32>;

// A direction about a unit normal; pdf cos / pi. The frame is that of Duff et al., "Building an
// Orthonormal Basis, Revisited", JCGT 2017.
fn cosine_hemisphere(n: vec3f, u: vec2f) -> vec3f {
    let s = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (s + n.z);
    let b = n.x * n.y * a;
    let x = vec3f(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    let y = vec3f(b, s + n.y * n.y * a, -n.y);
    let r = sqrt(u.x);
    let turn = 2.0 * PI * u.y;
    return normalize(x * (r * cos(turn)) + y * (r * sin(turn)) + n * sqrt(1.0 - u.x));
}

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let point = points[slot];
    let path = paths[slot];
    // Cosine sampling of a diffuse surface leaves the albedo as weight.
    let throughput = path.throughput * materials[point.surface & ~FRONT].albedo;
    let probability = survival(throughput);
    let lives = path_random(slot, path.stream, ROULETTE_DIMENSIONS).x < probability;
    let direction = cosine_hemisphere(point.normal, path_random(slot, path.stream, BOUNCE_DIMENSIONS));
    let origin = point.position + params.offset * point.normal;
    let limit = select(0.0, HUGE, id.x < params.paths && lives);
    let hit = traverse(origin, direction, limit, params.nodes, false, invocation);
    if id.x < params.paths { survivors[id.x] = select(slot, NOTHING, hit.triangle == NOTHING); }
    if hit.triangle != NOTHING {
        let next = hit_point(hit, direction);
        let carried = throughput / probability;
        points[slot] = next;
        paths[slot] = Path(carried, path.stream);
        find_emission(slot, carried, next, direction, dot(point.normal, direction));
    }
}
