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

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.blocks * 64u { return; }
    let pixel = pixel_of(id.x, params.first_block, params.width);
    let nothing = Point(vec3f(0.0), NOTHING, vec3f(0.0), 0.0);
    if pixel.x >= params.width || pixel.y >= params.height {
        points[id.x] = nothing;
        return;
    }
    var inside = vec2f(0.5);
    if params.samples > 1u {
        let stream = hash(hash(pixel.x + pixel.y * params.width) + params.seed);
        inside = scrambled(params.sample, stream);
    }
    let at = (vec2f(pixel) + inside) / vec2f(f32(params.width), f32(params.height)) * 2.0 - 1.0;
    let direction = normalize(params.forward + at.x * params.right - at.y * params.up);
    let hit = traverse(params.position, direction, HUGE, params.nodes, false);
    if hit.triangle == NOTHING {
        points[id.x] = nothing;
        return;
    }
    let corners = triangles[hit.triangle];
    let position = corners.a * hit.weights.x + corners.b * hit.weights.y + corners.c * hit.weights.z;
    let normal = normalize(cross(corners.b - corners.a, corners.c - corners.a));
    let front = dot(normal, direction) < 0.0;
    film[id.x].w += 1.0;
    points[id.x] = Point(
        position,
        corners.material | select(0u, FRONT, front),
        select(-normal, normal, front),
        hit.t,
    );
}
