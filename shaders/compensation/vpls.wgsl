// Light of virtual point lights at the vertices of bias compensation, bounded as at visible points:
// of several drawn evenly, one by what it is thought to give. Talbot, Cline and Egbert,
// "Importance Resampling for Global Illumination", EGSR 2005.

@group(0) @binding(4) var<storage, read> points: array<Point>;
// In w, the shadow rays.
@group(0) @binding(20) var<storage, read_write> radiance: array<vec4f>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(23) var<storage, read> queue: array<u32>;

const CANDIDATES = 16u;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = queue[min(id.x, params.paths - 1u)];
    let point = points[slot];
    let receiver = receiver_of(point);
    let by = returning(slot, point);
    let sight = sight_of(slot);
    let random = path_random(slot, paths[slot].stream, ROULETTE_DIMENSIONS);
    var chosen = 0u;
    var back = vec3f(0.0);
    var given = 0.0;
    var sum = 0.0;
    // One number decides all: what is left of it after a choice is uniform again.
    var u = random.y;
    for (var i = 0u; i < CANDIDATES; i++) {
        let at = u32((f32(i) + random.x) / f32(CANDIDATES) * f32(params.lights));
        let index = min(at, params.lights - 1u);
        let vpl = load_vpl(index);
        let between = vpl.position - point.position;
        let toward = between * inverseSqrt(max(dot(between, between), 1e-37));
        let candidate = gathered_back(by, toward, pair_of(receiver, vpl, 1u, 1u));
        let gives = thought_seen(sight, index) * (candidate.x + candidate.y + candidate.z) / 3.0;
        sum += gives;
        let share = select(0.0, gives / sum, gives > 0.0);
        if u < share {
            chosen = index;
            back = candidate;
            given = gives;
            u = u / share;
        } else {
            u = (u - share) / max(1.0 - share, 1e-7);
        }
    }
    let vpl = load_vpl(chosen);
    let is = id.x < params.paths && given > 0.0;
    let origin = vpl.position + params.offset * vpl.normal;
    let end = offset_position(point, params.offset);
    let limit = select(0.0, 1.0, is);
    let hit = traverse(origin, end - origin, limit, params.nodes, true, invocation);
    if is && hit.triangle == NOTHING {
        let weight = f32(params.lights) / f32(CANDIDATES) * (sum / given);
        radiance[slot] += vec4f(back * weight, 1.0);
    }
}
