// Camera rays: a visible point for a sample of every pixel of the tile.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
// In w, how many samples of the pixel hit something.
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let pixel = pixel_of(id.x, params.first_block, params.width);
    let is = id.x < params.blocks * 64u && pixel.x < params.width && pixel.y < params.height;
    var inside = vec2f(0.5);
    if params.samples > 1u { inside = scrambled(params.sample, camera_stream(pixel)); }
    let direction = camera_direction(pixel, inside);
    let limit = select(0.0, HUGE, is);
    let stream = camera_stream(pixel);
    let sight = follow(
        params.position, direction, limit, params.nodes, params.offset, params.sample, stream,
        invocation,
    );
    if sight.hit.triangle != NOTHING { film[id.x].w += 1.0; }
    if id.x < params.blocks * 64u {
        let point = hit_point(sight.hit, sight.direction);
        points[id.x] = with_view(point, way_back(point, sight.direction, params.offset));
        keep_albedo(id.x, sight.hit, point);
        keep_glow(id.x, sight.hit, point);
        keep_throughput(id.x, sight);
    }
}
