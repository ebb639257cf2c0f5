// The next segment of each path: a direction drawn by the BSDF, and what it hits.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(23) var<storage, read> queue: array<u32>;
@group(0) @binding(24) var<storage, read_write> survivors: array<u32>;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let point = points[slot];
    let path = paths[slot];
    let u = path_random(slot, path.stream, BOUNCE_DIMENSIONS);
    let scattered = scatter(point, albedo_of(slot, point), u);
    let throughput = path.throughput * scattered.weight;
    let probability = survival(throughput);
    let lives = path_random(slot, path.stream, ROULETTE_DIMENSIONS).x < probability;
    let limit = select(0.0, HUGE, id.x < params.paths && lives);
    let chain = follow_path(slot, path.stream, point, scattered.direction, limit, invocation);
    let hit = chain.hit;
    if id.x < params.paths { survivors[id.x] = select(slot, NOTHING, hit.triangle == NOTHING); }
    let carried = throughput / probability * throughput_of(chain);
    let density = found_density(point, scattered, chain);
    if hit.triangle != NOTHING {
        let next = hit_point(hit, chain.direction);
        points[slot] = with_view_direction(next, ray_offset(next, chain.direction, params.offset));
        store_albedo(slot, hit, next, chain.direction, 0.0);
        store_emission_scale(slot, hit, next, chain.direction, 0.0);
        paths[slot] = Path(carried, path.stream);
        find_emission(slot, carried, point, hit, next, chain.direction, density);
    } else if limit > 0.0 {
        find_background(slot, carried, chain.direction, density);
    }
}
