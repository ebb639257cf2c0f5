// Scattering at single points, for tests: what is asked in `queries`, and what comes out.

struct Query {
    normal: vec3f,
    surface: u32,
    // Of a ray towards the point.
    direction: vec3f,
    u: f32,
    // Away from it.
    toward: vec3f,
    v: f32,
    albedo: vec3f,
    pad: f32,
}

struct Answer {
    brdf: vec3f,
    density: f32,
    direction: vec3f,
    drawn: f32,
    weight: vec3f,
    side: f32,
    turned: vec3f,
    turned_weight: f32,
}

@group(0) @binding(50) var<storage, read> queries: array<Query>;
@group(0) @binding(51) var<storage, read_write> answers: array<Answer>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&queries) { return; }
    let q = queries[id.x];
    let point = with_view_direction(Point(vec3f(0.0), q.surface, q.normal, 0.0), -q.direction);
    let scattered = scatter(point, q.albedo, vec2f(q.u, q.v));
    let turned = sample_specular(point, bsdf_of(point), q.direction, q.u);
    answers[id.x] = Answer(
        brdf(point, q.albedo, q.toward),
        scatter_density(point, q.albedo, q.toward) * max(dot(q.normal, q.toward), 0.0),
        scattered.direction,
        scattered.density * dot(q.normal, scattered.direction),
        scattered.weight,
        turned.side,
        turned.direction,
        turned.weight.x,
    );
}
