// Irradiance from the point lights, each by one exact shadow ray.

struct DirectParams {
    points: u32,
    lights: u32,
    first: u32,
    count: u32,
    seed: u32,
    first_block: u32,
    offset: f32,
    nodes: u32,
    weight: f32,
    pad0: u32,
    pad1: u32,
    pad2: u32,
}

struct PointLight {
    position: vec3f,
    pad0: f32,
    intensity: vec3f,
    pad1: f32,
}

@group(0) @binding(0) var<uniform> params: DirectParams;
@group(0) @binding(4) var<storage, read> points: array<Point>;
@group(0) @binding(7) var<storage, read_write> irradiance: array<vec4f>;
@group(0) @binding(9) var<storage, read> lights: array<PointLight>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= params.points { return; }
    let point = points[id.x];
    if point.surface == NOTHING { return; }
    let origin = point.position + params.offset * point.normal;
    var sum = vec3f(0.0);
    for (var i = params.first; i < params.first + params.count; i++) {
        let light = lights[i];
        let to_light = light.position - point.position;
        let square = dot(to_light, to_light);
        let cosine = dot(to_light, point.normal);
        if cosine <= 0.0 { continue; }
        let hit = traverse(origin, light.position - origin, 1.0, params.nodes, true);
        if hit.triangle == NOTHING {
            sum += light.intensity * (cosine / (square * sqrt(square)));
        }
    }
    irradiance[id.x] += vec4f(sum, 0.0);
}
