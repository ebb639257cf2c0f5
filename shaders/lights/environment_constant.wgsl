// The same radiance from everywhere.

@group(0) @binding(80) var<storage, read> environment: array<u32>;

fn background(direction: vec3f) -> vec3f {
    return bitcast<vec3f>(vec3u(environment[0], environment[1], environment[2]));
}
