// The next segment of each path: a direction as the surface scatters, and what it hits.

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
    let sight = follow_path(slot, path.stream, point, scattered.direction, limit, invocation);
    let hit = sight.hit;
    if id.x < params.paths { survivors[id.x] = select(slot, NOTHING, hit.triangle == NOTHING); }
    let carried = throughput / probability * throughput_of(sight);
    let density = found_density(point, scattered, sight);
    if hit.triangle != NOTHING {
        let next = hit_point(hit, sight.direction);
        points[slot] = with_view(next, way_back(next, sight.direction, params.offset));
        keep_albedo(slot, hit, next);
        keep_glow(slot, hit, next);
        paths[slot] = Path(carried, path.stream);
        find_emission(slot, carried, point, hit, next, sight.direction, density);
    } else if limit > 0.0 {
        find_background(slot, carried, sight.direction, density);
    }
}
