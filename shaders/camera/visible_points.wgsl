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
    let chain = trace_specular_chain(
        params.position, direction, limit, params.nodes, params.offset, params.sample, stream,
        invocation,
    );
    if chain.hit.triangle != NOTHING { film[id.x].w += 1.0; }
    if id.x < params.blocks * 64u {
        let point = hit_point(chain.hit, chain.direction);
        points[id.x] = with_view_direction(point, ray_offset(point, chain.direction, params.offset));
        let width = pixel_spread(direction) * length_of(chain);
        store_albedo(id.x, chain.hit, point, chain.direction, width);
        store_emission_scale(id.x, chain.hit, point, chain.direction, width);
        store_throughput(id.x, chain);
    }
}
