// The visible points that `choose_points` has chosen in place of others: their ray is traced again.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(95) var<storage, read> choices: array<u32>;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let is_point = id.x < params.blocks * 64u;
    let choice = select(NOTHING, choices[min(id.x, params.blocks * 64u - 1u)], is_point);
    let is = choice != NOTHING;
    let ray = choice & 3u;
    let pixel = pixel_of(id.x, params.first_block, params.width);
    let stream = camera_stream(pixel);
    var places = first_places(stream);
    let chain = trace_specular_chain(
        params.position, camera_direction(pixel, places[ray]), select(0.0, HUGE, is),
        params.nodes, params.offset, ray * params.samples + params.sample, stream, invocation,
    );
    if is {
        let point = hit_point(chain.hit, chain.direction);
        points[id.x] = with_view_direction(point, ray_offset(point, chain.direction, params.offset));
        store_albedo(id.x, chain.hit, point);
        store_throughput(id.x, chain);
    }
}
