// What the passes of next-event estimation share: a shadow ray from the vertex of each path.

@group(0) @binding(4) var<storage, read> points: array<Point>;
// In w, the shadow rays.
@group(0) @binding(20) var<storage, read_write> radiance: array<vec4f>;
@group(0) @binding(22) var<storage, read> paths: array<Path>;
@group(0) @binding(23) var<storage, read> queue: array<u32>;

fn shadow_origin(point: Point) -> vec3f {
    return point.position + params.offset * point.normal;
}

// Traces to a light that gives this irradiance if nothing is between, at 0 < t < limit of a
// direction from where shadow rays start. All invocations of a subgroup must call it together.
fn receive(slot: u32, toward: vec3f, limit: f32, irradiance: vec3f, is: bool, invocation: u32) {
    let point = points[slot];
    let reach = select(0.0, limit, is);
    let hit = traverse(shadow_origin(point), toward, reach, params.nodes, true, invocation);
    if is {
        let reflectance = brdf(point, albedo_of(slot, point), normalize(toward));
        let received = select(irradiance, vec3f(0.0), hit.triangle != NOTHING);
        radiance[slot] += vec4f(paths[slot].throughput * reflectance * received, 1.0);
    }
}
