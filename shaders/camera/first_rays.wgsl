// The first camera rays of every pixel of the tile, as beams. The one nearest to the pixel's centre
// finds its visible point. Of each is kept where it ends, and the light that it sees without any
// visible point's help.

@group(0) @binding(4) var<storage, read_write> points: array<Point>;
@group(0) @binding(100) var<storage, read_write> ray_emission: array<vec4u>;
@group(0) @binding(101) var<storage, read_write> ray_highlights: array<vec4f>;
@group(0) @binding(103) var<storage, read_write> ray_places: array<vec4u>;
@group(0) @binding(104) var<storage, read_write> ray_surfaces: array<vec4u>;

// No invocation returns early: a subgroup traces its rays together.
@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3u,
    @builtin(local_invocation_index) invocation: u32,
) {
    let pixel = pixel_of(id.x, params.first_block, params.width);
    let is_point = id.x < params.blocks * 64u;
    let is = is_point && pixel.x < params.width && pixel.y < params.height;
    let stream = camera_stream(pixel);
    let rays = first_rays();
    var places = first_places(stream);
    var directions: array<vec3f, 4>;
    var limits = vec4f(0.0);
    var first = 0u;
    for (var i = 0u; i < 4u; i++) {
        directions[i] = camera_direction(pixel, places[i]);
        limits[i] = select(0.0, HUGE, is && i < rays);
        let nearer = distance(places[i], vec2f(0.5)) < distance(places[first], vec2f(0.5));
        if i < rays && nearer { first = i; }
    }
    var hits = traverse_beam(params.position, directions, limits, params.nodes, invocation);
    var sum = vec3f(0.0);
    var highlights = vec4f(0.0);
    var surfaces = vec4u(NOTHING);
    var throughputs = vec4u(0u);
    for (var i = 0u; i < rays; i++) {
        let chain = specular_chain_from(
            hits[i], directions[i], limits[i], params.nodes, params.offset,
            i * params.samples + params.sample, stream, invocation,
        );
        let point = hit_point(chain.hit, chain.direction);
        let emitted = select(vec3f(0.0), throughput_of(chain) * seen_without_light(chain.hit, point), is);
        sum += emitted;
        highlights[i] = max(emitted.x, max(emitted.y, emitted.z));
        surfaces[i] = point.surface;
        throughputs[i] = pack_throughput(throughput_of(chain));
        if is_point {
            let normal = pack4x8snorm(vec4f(point.normal, 0.0));
            ray_places[4u * id.x + i] = vec4u(bitcast<vec3u>(point.position), normal);
        }
        if is_point && i == first {
            let way = ray_offset(point, chain.direction, params.offset);
            points[id.x] = with_view_direction(point, way);
            store_albedo(id.x, chain.hit, point);
            store_throughput(id.x, chain);
        }
    }
    if is_point {
        ray_emission[id.x] = vec4u(bitcast<vec3u>(sum), 0u);
        ray_highlights[id.x] = highlights;
        ray_surfaces[id.x] = surfaces;
        store_ray_throughputs(id.x, throughputs);
    }
}
