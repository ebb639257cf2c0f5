// Camera rays: a visible point for a sample of every pixel of the tile; or other points in the place of
// some.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
// In w, how many samples of the pixel hit something.
@group(0) @binding(8) var<storage, read_write> film: array<vec4f>;

// No invocation returns early: a subgroup may trace its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let own = min(id.x, params.blocks * 64u - 1u);
    let pixel = pixel_of(own, params.first_block, params.width);
    let ray = point_ray(own, pixel);
    let stored = id.x == own && ray.is;
    let is = stored && pixel.x < params.width && pixel.y < params.height;
    let inside = select(scrambled(ray.number, ray.stream), vec2f(0.5), ray.in_middle);
    let direction = camera_direction(pixel, inside);
    let chain = trace_specular_chain(
        params.position, direction, select(0.0, HUGE, is), params.nodes, params.offset,
        ray.number, ray.stream, invocation,
    );
    // A loop, as a branch that no invocation takes is not skipped everywhere; and without the rays, as
    // triangles that are literals are slower in it.
    let rounds = select(0u, 1u, some_ray(stored));
    for (var round = 0u; round < rounds; round++) {
        if chain.hit.triangle != NOTHING && !ray.replaces { film[own].w += 1.0; }
        if stored {
            let point = hit_point(chain.hit, chain.direction);
            let way = ray_offset(point, chain.direction, params.offset);
            store_replaced(ray, pixel, point);
            points[own] = with_view_direction(point, way);
            let width = pixel_spread(direction) * length_of(chain);
            store_albedo(own, chain.hit, point, chain.direction, width);
            store_emission_scale(own, chain.hit, point, chain.direction, width);
            store_throughput(own, chain);
        }
    }
}
