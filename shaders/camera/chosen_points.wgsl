// The visible points that `choose_points` has chosen in place of others: their ray is traced again.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(105) var<storage, read> choices: array<u32>;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let point = min(id.x, params.blocks * 64u - 1u);
    let listed = list_points(id.x == point && choices[point] != NOTHING, point, invocation);
    let is = invocation < listed.count;
    let own = listed_points[select(0u, invocation, is)];
    let ray = choices[select(point, own, is)] & 3u;
    let pixel = pixel_of(own, params.first_block, params.width);
    let stream = camera_stream(pixel);
    var places = first_places(stream);
    let chain = trace_specular_chain(
        params.position, camera_direction(pixel, places[ray]), select(0.0, HUGE, is),
        params.nodes, params.offset, ray * params.samples + params.sample, stream, invocation,
    );
    if is {
        let seen = hit_point(chain.hit, chain.direction);
        points[own] = with_view_direction(seen, ray_offset(seen, chain.direction, params.offset));
        store_albedo(own, chain.hit, seen);
        store_throughput(own, chain);
    }
}
