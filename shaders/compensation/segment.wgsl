// The next segment of each path of bias compensation. It goes on with what the bound took from the
// light along it, which is something only where the segment is short; what the segment happens
// upon that emits is light straight from its source, which no bound is on.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(23) var<storage, read> queue: array<u32>;
@group(0) @binding(24) var<storage, read_write> survivors: array<u32>;

// A geometry term over the bound that is far above it, and any pair of lobes times it is finite.
const ALL_CLAMPED = 1e20;

// The geometry term between two points.
fn geometry(here: Point, there: Point) -> f32 {
    let d = there.position - here.position;
    let square = dot(d, d);
    let cosines = max(dot(d, here.normal), 0.0) * max(-dot(d, there.normal), 0.0);
    return cosines / max(square * square, 1e-37);
}

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let point = points[slot];
    let stream = paths[slot].stream;
    let albedo = albedo_of(slot, point);
    let drawn = scatter(point, albedo, path_random(slot, stream, BOUNCE_DIMENSIONS));
    let carried = carried_on(slot, point, albedo, drawn);
    let all = all_carried(carried);
    // Irradiance is sought, which is pi where a path from the camera has a throughput of 1.
    let probability = survival(all / PI);
    let lives = path_random(slot, stream, ROULETTE_DIMENSIONS).x < probability;
    let is = id.x < params.paths && lives;
    let first = params.bounce == 0u;
    // A segment from the visible point finds no light; the slack is of where the ray starts.
    let slack = 4.0 * distance(offset_position(point, params.offset), point.position);
    let far = min(1.01 * farthest(point, drawn.direction) + slack, HUGE);
    let limit = select(0.0, select(HUGE, far, first), is);
    let chain = follow_path(slot, stream, point, drawn.direction, limit, invocation);
    let hit = chain.hit;
    let throughput = throughput_of(chain) / probability;
    let density = found_density(point, drawn, chain);
    var goes_on = false;
    if is && hit.triangle != NOTHING {
        let next = hit_point(hit, chain.direction);
        // The light of virtual point lights comes by no mirror: nothing is clamped of what a
        // vertex sees in one, and the visible point has none of it.
        let turned = select(ALL_CLAMPED, 0.0, first);
        let relative = min(geometry(point, next) / geometry_bound(next), ALL_CLAMPED);
        let g = select(relative, turned, is_specular(chain));
        store_albedo(slot, hit, next, chain.direction, 0.0);
        store_emission_scale(slot, hit, next, chain.direction, 0.0);
        find_emission(slot, all * throughput, point, hit, next, chain.direction, density);
        let decides = path_random(slot, stream, SURVIVAL_DIMENSIONS).x;
        goes_on = arrive(slot, carried, next, throughput, g, decides);
        points[slot] = with_view_direction(next, ray_offset(next, chain.direction, params.offset));
    } else if is {
        find_background(slot, all * throughput, chain.direction, density);
    }
    if id.x < params.paths { survivors[id.x] = select(NOTHING, slot, goes_on); }
}
