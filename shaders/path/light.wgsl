// What the stages of next-event estimation share: a shadow ray from the vertex of each path.

@group(0) @binding(4) var<storage, read> points: array<Point>;
// In w, the shadow rays.
@group(0) @binding(20) var<storage, read_write> radiance: array<vec4f>;
@group(0) @binding(22) var<storage, read_write> paths: array<Path>;
@group(0) @binding(23) var<storage, read> queue: array<u32>;

// Traces to a light that gives this irradiance if nothing is between. All invocations of a subgroup
// must call it together.
fn receive(slot: u32, light: LightSample, irradiance: vec3f, is: bool, invocation: u32) {
    let point = points[slot];
    let origin = offset_position(point, params.offset);
    let limit = select(0.0, light.limit, is);
    let hit = traverse(origin, light.toward, limit, params.nodes, true, invocation);
    if is {
        let received = select(irradiance, vec3f(0.0), hit.triangle != NOTHING);
        let back = contribution_of(slot, point, normalize(light.toward), received);
        radiance[slot] += vec4f(back, 1.0);
    }
}
