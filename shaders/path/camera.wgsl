// Camera rays of paths: some samples of every pixel of the tile.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(20) var<storage, read_write> radiance: array<vec4f>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(24) var<storage, read_write> survivors: array<u32>;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let slot = id.x;
    let pixel = pixel_of(slot / params.rays, params.first_block, params.width);
    let is = slot < params.blocks * 64u * params.rays;
    let stream = camera_stream(pixel);
    var inside = vec2f(0.5);
    if params.samples > 1u { inside = scrambled(params.sample + slot % params.rays, stream); }
    let direction = camera_direction(pixel, inside);
    let limit = select(0.0, HUGE, is && pixel.x < params.width && pixel.y < params.height);
    let chain = trace_specular_chain(
        params.position, direction, limit, params.nodes, params.offset,
        params.sample + slot % params.rays, stream, invocation,
    );
    if is {
        let point = hit_point(chain.hit, chain.direction);
        points[slot] = with_view_direction(point, ray_offset(point, chain.direction, params.offset));
        let width = pixel_spread(direction) * length_of(chain);
        store_albedo(slot, chain.hit, point, chain.direction, width);
        store_emission_scale(slot, chain.hit, point, chain.direction, width);
        radiance[slot] = vec4f(0.0);
        paths[slot] = Path(throughput_of(chain), stream);
        survivors[slot] = select(slot, NOTHING, chain.hit.triangle == NOTHING);
    }
}
