// Antialiasing of edges. Where the pixels around see one surface, a pixel has the radiance of
// its visible point. Elsewhere more camera rays find what is seen in the pixel, and each takes
// the radiance of the nearest visible point around on the same surface: light varies slowly
// along a surface, so that coverage alone needs the rays.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;
@group(0) @binding(20) var<storage, read> radiance: array<vec4f>;

// More than any squared distance in normalised units, and little more: what is added is not lost.
const FARTHEST = 16.0;

fn alike(p: Point, q: Point) -> bool {
    let same = one_surface(p.normal, q.normal, q.position - p.position);
    return p.surface == q.surface && (same || p.surface == NOTHING);
}

// The point of the i-th of the 3 x 3 pixels around one; itself where there is none.
fn around(pixel: vec2u, own: u32, i: u32) -> u32 {
    let other = vec2i(pixel) + vec2i(i32(i % 3u), i32(i / 3u)) - 1;
    let first = i32(params.first_block / ((params.width + 7u) / 8u)) * 8;
    let index = point_of(vec2u(other - vec2i(0, first)), params.width);
    let is = other.x >= 0 && other.x < i32(params.width) && other.y >= first
        && other.y < i32(params.height) && index < params.blocks * 64u;
    return select(own, index, is);
}

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let own = min(id.x, params.blocks * 64u - 1u);
    let pixel = pixel_of(own, params.first_block, params.width);
    let point = points[own];
    let is = id.x == own && pixel.x < params.width && pixel.y < params.height;
    var edge = false;
    let own_throughput = stored_throughput(own);
    if own_throughput.w > 0.0 { edge = true; }
    for (var i = 0u; i < 9u; i++) { edge = edge || !alike(point, points[around(pixel, own, i)]); }

    var sum = vec3f(0.0);
    let all = params.edge_rays * params.samples;
    let stream = hash(camera_stream(pixel));
    let limit = select(0.0, HUGE, is && edge);
    let rays = select(0u, params.rays, some_ray(is && edge));
    for (var ray = params.first_ray; ray < params.first_ray + rays; ray++) {
        let index = ray * params.samples + params.sample;
        let direction = camera_direction(pixel, stratified(index, 1.0 / f32(all), stream));
        let chain = trace_specular_chain(
            params.position, direction, limit, params.nodes, params.offset, index, stream,
            invocation,
        );
        let seen = hit_point(chain.hit, chain.direction);
        // The nearest on the same surface; if there is none, the nearest of all.
        var best = own;
        var least = HUGE;
        for (var i = 0u; i < 9u; i++) {
            let index = around(pixel, own, i);
            let other = points[index];
            let way = other.position - seen.position;
            let far = select(FARTHEST, 0.0, alike(seen, other));
            let distance = far + dot(way, way);
            best = select(best, index, distance < least);
            least = min(least, distance);
        }
        sum += seen_by_ray(seen, radiance[best].rgb) * throughput_of(chain);
    }
    let share = f32(params.rays) / f32(params.edge_rays);
    let result = select(radiance[own].rgb * own_throughput.rgb * share, sum / f32(params.edge_rays), edge);
    if is { film[own] += vec4f(result, 0.0); }
}
