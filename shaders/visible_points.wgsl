// Camera rays: a visible point for a sample of every pixel of the tile.

struct CameraParams {
    position: vec3f,
    width: u32,
    forward: vec3f,
    height: u32,
    right: vec3f,
    first_block: u32,
    up: vec3f,
    sample: u32,
    samples: u32,
    seed: u32,
    blocks: u32,
    nodes: u32,
}

@group(0) @binding(0) var<uniform> params: CameraParams;
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
    if params.samples > 1u {
        let stream = hash(hash(pixel.x + pixel.y * params.width) + params.seed);
        inside = scrambled(params.sample, stream);
    }
    let at = (vec2f(pixel) + inside) / vec2f(f32(params.width), f32(params.height)) * 2.0 - 1.0;
    let direction = normalize(params.forward + at.x * params.right - at.y * params.up);
    let limit = select(0.0, HUGE, is);
    let hit = traverse(params.position, direction, limit, params.nodes, false, invocation);

    var point = Point(vec3f(0.0), NOTHING, vec3f(0.0), 0.0);
    if hit.triangle != NOTHING {
        let corners = load_triangle(hit.triangle);
        let normal = normalize(cross(corners.b - corners.a, corners.c - corners.a));
        let front = dot(normal, direction) < 0.0;
        point = Point(
            corners.a * hit.weights.x + corners.b * hit.weights.y + corners.c * hit.weights.z,
            corners.material | select(0u, FRONT, front),
            select(-normal, normal, front),
            hit.t,
        );
        film[id.x].w += 1.0;
    }
    if id.x < params.blocks * 64u { points[id.x] = point; }
}
