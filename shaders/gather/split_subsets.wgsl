// Visible points from the order of pixels into that of subsets.

@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(16) var<storage, read_write> split_points: array<Point>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    let subset = id.x / params.subset_points;
    let place = (subset + params.s * params.s - params.rotation) % (params.s * params.s);
    let pixel = params.s * pixel_of(id.x % params.subset_points, 0u, params.subset_width)
        + vec2u(place % params.s, place / params.s);
    let is = all(pixel < vec2u(params.width, params.height));
    var point = points[point_of(min(pixel, vec2u(params.width, params.height) - 1u), params.width)];
    if !is { point.surface = NOTHING; }
    split_points[id.x] = point;
}
