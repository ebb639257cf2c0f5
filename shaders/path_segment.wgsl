// The next segment of each path: a direction as the surface scatters, and what it hits.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(23) var<storage, read> queue: array<u32>;
@group(0) @binding(24) var<storage, read_write> survivors: array<u32>;

// Scrambles what decides at mirrors and glass.
const TURN_STREAM = 0x7475726eu;
// So dense is no other way to the same place.
const CERTAIN = 1e15;

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
    let direction = scattered.direction;
    let origin = point.position + params.offset * point.normal;
    let limit = select(0.0, HUGE, id.x < params.paths && lives);
    let number = params.first_sample + slot % params.samples;
    let sight = follow(
        origin, direction, limit, params.nodes, params.offset, number,
        hash(path.stream ^ hash(TURN_STREAM + params.bounce)), invocation,
    );
    let hit = sight.hit;
    if id.x < params.paths { survivors[id.x] = select(slot, NOTHING, hit.triangle == NOTHING); }
    let carried = throughput / probability * throughput_of(sight);
    // No shadow ray would have gone this way if it was turned.
    let drawn = scattered.density * dot(point.normal, direction);
    let density = select(drawn, CERTAIN, is_turned(sight));
    if hit.triangle != NOTHING {
        let next = hit_point(hit, sight.direction, params.offset);
        points[slot] = with_view(next, sight.direction);
        keep_albedo(slot, hit, next);
        keep_glow(slot, hit, next);
        paths[slot] = Path(carried, path.stream);
        find_emission(slot, carried, point, hit, next, sight.direction, density);
    } else if limit > 0.0 {
        find_background(slot, carried, sight.direction, density);
    }
}
