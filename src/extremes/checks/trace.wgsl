// Traces an array of rays: what they hit, or whether they hit anything.

struct TraceParams {
    rays: u32,
    nodes: u32,
    any: u32,
    pad: u32,
}

struct TraceRay {
    origin: vec3f,
    limit: f32,
    direction: vec3f,
    pad: u32,
}

struct TraceHit {
    weights: vec3f,
    t: f32,
    // In the scene, not in leaf order; NOTHING if there is no hit.
    triangle: u32,
    material: u32,
    pad0: u32,
    pad1: u32,
}

@group(0) @binding(0) var<storage, read> params: TraceParams;
@group(0) @binding(3) var<storage, read> rays: array<TraceRay>;
@group(0) @binding(4) var<storage, read_write> hits: array<TraceHit>;

@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(subgroup_invocation_id) invocation: u32,
) {
    let ray = rays[min(id.x, params.rays - 1u)];
    let limit = select(0.0, ray.limit, id.x < params.rays);
    let hit = traverse(
        ray.origin,
        ray.direction,
        limit,
        params.nodes,
        params.any != 0u,
        invocation,
    );
    if id.x >= params.rays { return; }
    if hit.triangle == NOTHING {
        hits[id.x] = TraceHit(vec3f(0.0), hit.t, NOTHING, NOTHING, 0u, 0u);
        return;
    }
    let triangle = load_triangle(hit.triangle);
    hits[id.x] = TraceHit(hit.weights, hit.t, triangle.index, triangle.material, 0u, 0u);
}
